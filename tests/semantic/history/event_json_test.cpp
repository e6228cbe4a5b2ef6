// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/event_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "tests/support/event_list.h"

namespace oikos::semantic {
namespace {

Event parse(const std::string& text) {
  return eventFromJson(nlohmann::json::parse(text), "here");
}

std::string refusalOf(const std::string& text) {
  try {
    (void)parse(text);
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kInput);
    return error.what();
  }
  return "";
}

TEST(EventJson, ASightingWithAllItsKeys) {
  const Event event =
      parse(R"({"time":"2026-03-02T08:00:05.5+01:00","recording":"r","frame":150,"subject":"cup","kind":"sighted","confidence":0.5,)"
            R"("evidence":"evidence/a.jpg","before":{"parent":"table","relation":"on","pose":[0,0,0,0,0,0]},)"
            R"("after":{"parent":"shelf","relation":"in","pose":[1,2,3,10,20,90]}})");
  EXPECT_EQ(event.time_ns, 1772434805'500000000);
  EXPECT_EQ(event.recording, "r");
  EXPECT_EQ(event.frame, 150);
  EXPECT_EQ(event.kind, EventKind::kSighted);
  EXPECT_EQ(event.confidence, 0.5);
  EXPECT_EQ(event.evidence, "evidence/a.jpg");
  EXPECT_EQ(std::get<Placement>(*event.before).parent, "table");
  const auto& after = std::get<Placement>(*event.after);
  EXPECT_EQ(after.relation, Relation::kIn);
  EXPECT_EQ(after.T_parent_object.position_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(after.T_parent_object.roll_pitch_yaw_rad, Eigen::Vector3d(10, 20, 90) * kRadPerDeg);
}

TEST(EventJson, EveryKindOfStateReadsBackAsItWas) {
  const Pose pose{{0.1, -0.2, 1.0 / 3.0}, {0.1, 0.2, -3.0}};
  const std::vector<State> states{Placement{"p", Relation::kUnder, pose}, FurniturePose{pose},
                                  JointValue{JointType::kRevolute, 95 * kRadPerDeg}, JointValue{JointType::kPrismatic, 0.25},
                                  KnobSetting{"180 degrees"}};
  for (const State& state : states) {
    const State again = stateFromJson(nlohmann::json::parse(toJson(state).dump()), "");
    EXPECT_EQ(toJson(again), toJson(state));
    EXPECT_EQ(again.index(), state.index());
  }
  EXPECT_EQ(toJson(states[2]).dump(), R"({"value_deg":95.0})");
}

TEST(EventJson, TheSampleHistoryReadsBackAsItWas) {
  const auto events = test::readEvents(std::string(OIKOS_SOURCE_DIR) + "/tests/data/questions/demo_events.jsonl");
  ASSERT_EQ(events.size(), 45U);
  for (const Event& event : events) {
    const nlohmann::json json = nlohmann::json::parse(toJson(event).dump());
    EXPECT_EQ(eventFromJson(json, ""), event) << json;
  }
}

TEST(EventJson, SaysWhichKeyIsWrong) {
  const std::string good = R"("time":"2026-03-02T08:00:05Z","subject":"cup","kind":"sighted")";
  EXPECT_EQ(refusalOf("{" + good + "}"), "");
  EXPECT_NE(refusalOf("[]").find("expected an object"), std::string::npos);
  EXPECT_NE(refusalOf(R"({"subject":"cup","kind":"sighted"})").find("no 'time'"), std::string::npos);
  EXPECT_NE(refusalOf(R"({"time":"yesterday","subject":"cup","kind":"sighted"})").find("time = \"yesterday\": expected a time"),
            std::string::npos);
  EXPECT_NE(refusalOf(R"({"time":"2026-03-02T08:00:05Z","subject":"cup","kind":"seen"})").find("expected one of sighted, missed"),
            std::string::npos);
  EXPECT_NE(refusalOf("{" + good + R"(,"sure":1})").find("unknown key 'sure'"), std::string::npos);
  EXPECT_NE(refusalOf("{" + good + R"(,"confidence":1.5})").find("from 0 to 1"), std::string::npos);
  EXPECT_NE(refusalOf("{" + good + R"(,"frame":-1})").find("frame = -1"), std::string::npos);
  EXPECT_NE(refusalOf("{" + good + R"(,"after":{}})").find("here: after"), std::string::npos);
  EXPECT_NE(refusalOf("{" + good + R"(,"after":{"pose":[0,0,0,0,0]}})").find("six finite numbers"), std::string::npos);
  EXPECT_NE(refusalOf("{" + good + R"(,"after":{"pose":[0,0,0,0,0,null]}})"), "");
  EXPECT_NE(refusalOf("{" + good + R"(,"after":{"setting":"on","value_m":1}})").find("unknown key"), std::string::npos);
}

}  // namespace
}  // namespace oikos::semantic
