// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/revert.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "semantic/history/home_state.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

using Names = std::vector<std::string>;

constexpr std::int64_t kLate = std::numeric_limits<std::int64_t>::max();

Event knob(const std::string& subject, std::int64_t time_ns, const std::string& state, const std::string& recording) {
  Event event;
  event.subject = subject;
  event.time_ns = time_ns;
  event.kind = EventKind::kKnob;
  event.after = KnobSetting{state};
  event.recording = recording;
  return event;
}

class RevertTest : public testing::Test {
 protected:
  void append(const std::vector<Event>& events) { (void)history_.append(events); }
  [[nodiscard]] std::string settingOf(const std::string& subject, std::int64_t time_ns = kLate) const {
    const auto event = history_.findStateAt(subject, time_ns);
    return event ? std::get<KnobSetting>(*event->after).state : "none";
  }

  test::TemporaryFolder folder_;
  History history_{folder_.path() / "history.sqlite", HistoryAccess::kAppend};
};

TEST_F(RevertTest, TheStateFromBeforeIsBack) {
  append({knob("oven", 10, "on", "a"), knob("oven", 20, "hot", "b"), knob("oven", 30, "hotter", "b")});
  const Revert revert = revertRecording(history_, "b");
  EXPECT_EQ(revert.events, 2);
  EXPECT_EQ(revert.subjects, Names{"oven"});
  EXPECT_EQ(revert.restored, Names{"oven"});
  EXPECT_EQ(settingOf("oven"), "on");
  EXPECT_EQ(settingOf("oven", 25), "on");
  const Event event = history_.eventsOf("oven").back();
  EXPECT_EQ(event.kind, EventKind::kReverted);
  EXPECT_EQ(event.recording, "b");
  EXPECT_EQ(event.time_ns, 30);
  EXPECT_EQ(event.before, State(KnobSetting{"hotter"}));
  EXPECT_EQ(event.after, State(KnobSetting{"on"}));
}

TEST_F(RevertTest, WhereNothingElseIsKnownItIsWhatItsFirstEventFound) {
  Event first = knob("oven", 10, "on", "a");
  first.before = KnobSetting{"off"};
  Event second = knob("oven", 20, "hot", "a");
  second.before = first.after;
  append({first, second, knob("tap", 5, "open", "a")});
  EXPECT_EQ(revertRecording(history_, "a").restored, Names{"oven"});
  EXPECT_EQ(settingOf("oven"), "off");
  EXPECT_EQ(settingOf("tap"), "none");
}

TEST_F(RevertTest, WhatIsNewerStays) {
  append({knob("oven", 10, "on", "a"), knob("oven", 20, "hot", "b"), knob("oven", 30, "off", "c")});
  const Revert revert = revertRecording(history_, "b");
  EXPECT_EQ(revert.subjects, Names{"oven"});
  EXPECT_TRUE(revert.restored.empty());
  EXPECT_EQ(settingOf("oven"), "off");
  EXPECT_EQ(settingOf("oven", 29), "on");
}

TEST_F(RevertTest, WhatWasHandedInLaterAboutEarlierComesBack) {
  append({knob("oven", 20, "hot", "b"), knob("oven", 10, "on", "a")});
  (void)revertRecording(history_, "b");
  EXPECT_EQ(settingOf("oven"), "on");
}

TEST_F(RevertTest, AMissIsTakenBackWithoutAState) {
  Event missed = knob("cup", 20, "x", "b");
  missed.kind = EventKind::kMissed;
  append({knob("cup", 10, "here", "a"), missed});
  const Revert revert = revertRecording(history_, "b");
  EXPECT_EQ(revert.events, 1);
  EXPECT_TRUE(revert.restored.empty());
  EXPECT_EQ(settingOf("cup"), "here");
  EXPECT_EQ(history_.eventsOf("cup").size(), 2U);
}

TEST_F(RevertTest, ASecondTimeThereIsNothingUntilItComesAgain) {
  append({knob("oven", 10, "on", "a"), knob("oven", 20, "hot", "b")});
  EXPECT_EQ(revertRecording(history_, "b").events, 1);
  const std::int64_t last = history_.lastNumber();
  EXPECT_EQ(revertRecording(history_, "b").events, 0);
  EXPECT_EQ(revertRecording(history_, "never").events, 0);
  EXPECT_EQ(history_.lastNumber(), last);
  append({knob("oven", 20, "warm", "b")});
  EXPECT_EQ(settingOf("oven"), "warm");
  EXPECT_EQ(revertRecording(history_, "b").events, 1);
  EXPECT_EQ(settingOf("oven"), "on");
}

TEST_F(RevertTest, OneAfterTheOtherLeadsBackToTheStart) {
  Event first = knob("oven", 10, "on", "a");
  first.before = KnobSetting{"off"};
  append({first, knob("oven", 20, "hot", "b"), knob("oven", 30, "hotter", "c")});
  (void)revertRecording(history_, "b");
  EXPECT_EQ(settingOf("oven"), "hotter");
  (void)revertRecording(history_, "c");
  EXPECT_EQ(settingOf("oven"), "on");
  (void)revertRecording(history_, "a");
  EXPECT_EQ(settingOf("oven"), "off");
}

TEST_F(RevertTest, InTheOrderOfTheirTimesTheyLeadThereToo) {
  Event first = knob("oven", 10, "on", "a");
  first.before = KnobSetting{"off"};
  Event second = knob("oven", 20, "hot", "b");
  second.before = first.after;
  append({first, second});
  EXPECT_TRUE(revertRecording(history_, "a").restored.empty());
  EXPECT_EQ(settingOf("oven"), "hot");
  (void)revertRecording(history_, "b");
  EXPECT_EQ(settingOf("oven"), "off");
}

TEST_F(RevertTest, APastThatWasTakenBackIsNotWhatWasThereBefore) {
  HomeState now(readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml").home);
  const State at_first = now.findState("fridge-thermostat").value();
  Event wrong = knob("fridge-thermostat", 10, "off", "a");
  wrong.before = at_first;
  append({wrong});
  (void)revertRecording(history_, "a");
  append({knob("fridge-thermostat", 30, "4", "b")});
  now.takeNewFrom(history_);
  EXPECT_EQ(HomeState(homeAt(now.home(), history_, 5)).findState("fridge-thermostat"), at_first);
  EXPECT_EQ(HomeState(homeAt(now.home(), history_, 25)).findState("fridge-thermostat"), at_first);
}

TEST_F(RevertTest, KnowsTheNamesOfAllRecordings) {
  append({knob("oven", 10, "on", "b"), knob("oven", 20, "hot", "a"), knob("tap", 20, "hot", "a"), knob("tap", 20, "hot", "")});
  (void)revertRecording(history_, "b");
  EXPECT_EQ(history_.recordings(), (Names{"a", "b"}));
}

}  // namespace
}  // namespace oikos::semantic
