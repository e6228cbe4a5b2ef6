// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/home_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "core/base/rfc3339.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/event_list.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

const std::filesystem::path kSource(OIKOS_SOURCE_DIR);

Home demoHome() {
  return readHome(kSource / "homes/household/home.xml").home;
}

std::vector<Event> demoEvents() {
  return test::readEvents((kSource / "tests/data/questions/demo_events.jsonl").string());
}

std::int64_t at(const std::string& time) {
  return base::parseRfc3339Ns(time).value();
}

Event event(EventKind kind, const std::string& subject, const State& after) {
  Event made;
  made.kind = kind;
  made.subject = subject;
  made.after = after;
  return made;
}

const SmallObject& smallObject(const Home& home, const std::string& id) {
  for (const Room& room : home.rooms) {
    for (const LargeObject& object : room.objects) {
      for (const SmallObject& small : object.small_objects) {
        if (small.id.value == id) {
          EXPECT_TRUE(small.parent == object.id.value || object.articulation);
          return small;
        }
      }
    }
    for (const SmallObject& small : room.small_objects) {
      if (small.id.value == id) {
        EXPECT_EQ(small.parent, room.id.value);
        return small;
      }
    }
  }
  throw std::runtime_error("no " + id);
}

class DemoHistory : public testing::Test {
 protected:
  DemoHistory() { (void)history_.append(demoEvents()); }
  test::TemporaryFolder folder_;
  History history_{folder_.path() / "history.sqlite", HistoryAccess::kAppend};
};

TEST_F(DemoHistory, ReplayedItGivesTheNewestStates) {
  HomeState state(demoHome());
  state.takeNewFrom(history_);
  EXPECT_EQ(state.home().as_of, 45);
  const SmallObject& cup = smallObject(state.home(), "blue-cup");
  EXPECT_EQ(cup.parent, "kitchen-table");
  EXPECT_NEAR(cup.T_parent_object.roll_pitch_yaw_rad.z(), 60 * kRadPerDeg, 1e-12);
  EXPECT_EQ(cup.last_seen_ns, at("2026-03-11T17:50:00Z"));
  EXPECT_EQ(cup.confidence, 0.93);
  EXPECT_EQ(smallObject(state.home(), "phone").parent, "left-nightstand-body");
  EXPECT_NEAR(std::get<JointValue>(state.findState("wardrobe-left-hinge").value()).value, 85 * kRadPerDeg, 1e-12);
  EXPECT_EQ(std::get<KnobSetting>(state.findState("oven-temperature").value()).state, "off");
  EXPECT_NEAR(std::get<FurniturePose>(state.findState("coffee-table").value()).T_map_object.position_m.x(), 5.3, 1e-12);
}

TEST_F(DemoHistory, TheOrderOfCommitsDoesNotMatter) {
  HomeState in_order(demoHome());
  in_order.takeNewFrom(history_);
  std::vector<Event> events = demoEvents();
  std::reverse(events.begin(), events.end());
  const test::TemporaryFolder folder;
  History backwards(folder.path() / "history.sqlite", HistoryAccess::kAppend);
  HomeState state(demoHome());
  for (const Event& e : events) {
    (void)backwards.append({&e, 1});
    state.takeNewFrom(backwards);
  }
  for (const std::string& subject : history_.subjects()) {
    EXPECT_EQ(state.findState(subject), in_order.findState(subject)) << subject;
  }
}

TEST_F(DemoHistory, TheHomeAtAnEarlierTime) {
  HomeState now(demoHome());
  now.takeNewFrom(history_);
  const Home then = homeAt(now.home(), history_, at("2026-03-04T20:00:00Z"));
  EXPECT_EQ(smallObject(then, "blue-cup").parent, "coffee-table");
  EXPECT_EQ(smallObject(then, "blue-cup").last_seen_ns, at("2026-03-04T18:03:00Z"));
  EXPECT_EQ(smallObject(then, "reading-glasses").parent, "washbasin");
  EXPECT_FALSE(smallObject(then, "phone").last_seen_ns);  // first seen a week later
  EXPECT_TRUE(homeAt(now.home(), history_, at("2027-01-01T00:00:00Z")) == now.home());
}

TEST_F(DemoHistory, BeforeItsFirstChangeAThingIsWhereTheChangeFoundIt) {
  HomeState state(demoHome());
  Event moved = event(EventKind::kMoved, "sofa", FurniturePose{{.position_m = {9, 9, 0}}});
  moved.time_ns = at("2026-03-12T08:00:00Z");
  moved.before = FurniturePose{{.position_m = {1, 2, 0}}};
  (void)history_.append({&moved, 1});
  state.takeNewFrom(history_);
  const HomeState then(homeAt(state.home(), history_, at("2026-03-12T07:59:59Z")));
  EXPECT_EQ(then.findState("sofa"), moved.before);
  EXPECT_EQ(state.findState("sofa"), moved.after);
}

TEST(HomeState, ACheckRefusesWhatCannotBe) {
  const HomeState state(demoHome());
  const Pose pose;
  const auto refusal = [&](const Event& e) -> std::string {
    try {
      state.check(e);
    } catch (const base::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(event(EventKind::kSighted, "blue-cup", Placement{"sofa", Relation::kOn, pose})), "");
  EXPECT_EQ(refusal(event(EventKind::kJoint, "fridge-hinge", JointValue{JointType::kRevolute, 0.5})), "");
  EXPECT_NE(refusal(event(EventKind::kSighted, "nothing", Placement{"sofa", Relation::kOn, pose})).find("no such thing"),
            std::string::npos);
  EXPECT_NE(refusal(event(EventKind::kSighted, "blue-cup", Placement{"nowhere", Relation::kOn, pose})).find("'nowhere'"),
            std::string::npos);
  EXPECT_NE(refusal(event(EventKind::kSighted, "blue-cup", Placement{"red-cup", Relation::kOn, pose})).find("'red-cup'"),
            std::string::npos);
  EXPECT_NE(refusal(event(EventKind::kSighted, "blue-cup", KnobSetting{"on"})).find("a placement"), std::string::npos);
  EXPECT_NE(refusal(event(EventKind::kJoint, "fridge-hinge", JointValue{JointType::kPrismatic, 0.5})).find("value_deg"), std::string::npos);
  EXPECT_NE(refusal(event(EventKind::kJoint, "fridge-hinge", JointValue{JointType::kRevolute, 9.0})).find("limits"), std::string::npos);
  EXPECT_NE(refusal(event(EventKind::kKnob, "oven-temperature", KnobSetting{"lukewarm"})).find("the knob's states"), std::string::npos);
  EXPECT_NE(refusal(event(EventKind::kMoved, "sofa", KnobSetting{"on"})).find("a pose"), std::string::npos);
  EXPECT_NE(refusal(event(EventKind::kMoved, "kitchen", FurniturePose{pose})).find("no state of its own"), std::string::npos);
  Event empty = event(EventKind::kMoved, "sofa", FurniturePose{pose});
  empty.after.reset();
  EXPECT_NE(refusal(empty).find("no 'after'"), std::string::npos);
}

TEST(HomeState, ATakenBackSightingIsForgottenByTheHome) {
  const test::TemporaryFolder folder;
  History history(folder.path() / "history.sqlite", HistoryAccess::kAppend);
  HomeState state(demoHome());
  const State before = state.findState("blue-cup").value();
  Event sighting = event(EventKind::kSighted, "blue-cup", Placement{"sofa", Relation::kOn, {}});
  sighting.recording = "r";
  sighting.time_ns = 100;
  sighting.before = before;
  (void)history.append({&sighting, 1});
  state.takeNewFrom(history);
  EXPECT_EQ(smallObject(state.home(), "blue-cup").last_seen_ns, 100);
  Event back = sighting;
  back.kind = EventKind::kReverted;
  back.after = before;
  (void)history.append({&back, 1});
  state.takeNewFrom(history);
  EXPECT_EQ(state.findState("blue-cup"), before);
  EXPECT_FALSE(smallObject(state.home(), "blue-cup").last_seen_ns);
}

TEST(LoadHome, TakesTheFileAndWhatCameAfterIt) {
  const test::TemporaryFolder folder;
  (void)folder.write("home.xml", base::readFile(kSource / "homes/household/home.xml"));
  EXPECT_EQ(loadHome(folder.path()).as_of, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "history.sqlite"));
  (void)History(folder.path() / "history.sqlite", HistoryAccess::kAppend).append(demoEvents());
  const Home home = loadHome(folder.path());
  EXPECT_EQ(home.as_of, 45);
  EXPECT_EQ(smallObject(home, "car-keys").confidence, 0.83);
  (void)folder.write("home.xml", "<apartment/>");
  EXPECT_THROW((void)loadHome(folder.path()), base::Error);
}

}  // namespace
}  // namespace oikos::semantic
