// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/history.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

constexpr std::int64_t kLate = std::numeric_limits<std::int64_t>::max();

Event knob(const std::string& subject, std::int64_t time_ns, const std::string& state, const std::string& recording = "") {
  Event event;
  event.subject = subject;
  event.time_ns = time_ns;
  event.kind = EventKind::kKnob;
  event.after = KnobSetting{state};
  event.recording = recording;
  return event;
}

Event reverted(const Event& what, const std::optional<State>& back_to) {
  Event event = what;
  event.kind = EventKind::kReverted;
  event.after = back_to;
  return event;
}

std::string settingOf(const std::optional<Event>& event) {
  return event ? std::get<KnobSetting>(*event->after).state : "none";
}

void append(History& history, const std::vector<Event>& events) {
  (void)history.append(events);
}

class HistoryTest : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "history.sqlite";
};

TEST_F(HistoryTest, EventsComeBackAsTheyWereWithTheirNumbers) {
  History history(file_, HistoryAccess::kAppend);
  Event sighting;
  sighting.time_ns = 5;
  sighting.recording = "r";
  sighting.frame = 7;
  sighting.subject = "cup";
  sighting.before = Placement{"table", Relation::kOn, {.position_m = {1, 2, 3}}};
  sighting.after = Placement{"shelf", Relation::kIn, {{0.1, 0.2, 0.3}, {0, 0, 30 * kRadPerDeg}}};
  sighting.confidence = 0.25;
  sighting.evidence = "evidence/1.jpg";
  EXPECT_EQ(history.append(std::vector{sighting, knob("oven", 6, "on")}), 2);
  EXPECT_EQ(history.append(std::vector{knob("oven", 7, "off")}), 3);
  EXPECT_EQ(history.lastNumber(), 3);
  const auto events = history.eventsAfter(0, 100);
  ASSERT_EQ(events.size(), 3U);
  sighting.number = 1;
  EXPECT_EQ(events[0], sighting);
  EXPECT_EQ(events[2].number, 3);
  EXPECT_EQ(history.eventsAfter(1, 1).size(), 1U);
  EXPECT_EQ(history.eventsAfter(3, 100).size(), 0U);
}

TEST_F(HistoryTest, TheStateAtAnyTimeIsThatOfASlowSearch) {
  std::mt19937 random(3);
  History history(file_, HistoryAccess::kAppend);
  std::vector<Event> events;
  for (int i = 0; i < 500; ++i) {
    const std::string recording = "r" + std::to_string(random() % 5);
    events.push_back(knob("s" + std::to_string(random() % 4), static_cast<std::int64_t>(random() % 100), std::to_string(i), recording));
    events.back().kind = random() % 4 == 0 ? EventKind::kMissed : EventKind::kKnob;
  }
  append(history, events);
  append(history, {reverted(knob("s0", 50, "", "r3"), KnobSetting{"back"})});
  const auto counts = [&](const Event& e) { return e.recording != "r3" && e.kind != EventKind::kMissed; };
  for (int subject = 0; subject < 4; ++subject) {
    const std::string name = "s" + std::to_string(subject);
    for (std::int64_t time = -1; time <= 101; ++time) {
      std::string expected = "none";
      std::string next = "none";
      std::int64_t best = -1;
      for (const Event& e : events) {
        if (e.subject == name && counts(e) && e.time_ns <= time && e.time_ns >= best) {
          best = e.time_ns;
          expected = settingOf(e);
        }
      }
      best = kLate;
      for (const Event& e : events) {
        if (e.subject == name && counts(e) && e.time_ns > time && e.time_ns < best) {
          best = e.time_ns;
          next = settingOf(e);
        }
      }
      if (name != "s0") {  // there the reverting event has a state of its own
        EXPECT_EQ(settingOf(history.findStateAt(name, time)), expected) << name << " at " << time;
        EXPECT_EQ(settingOf(history.findStateAfter(name, time)), next) << name << " after " << time;
      }
    }
  }
  EXPECT_EQ(settingOf(history.findStateAt("nobody", kLate)), "none");
  EXPECT_EQ(history.subjects(), (std::vector<std::string>{"s0", "s1", "s2", "s3"}));
}

TEST_F(HistoryTest, ATakenBackRecordingSaysNothingMoreAndMayComeAgain) {
  History history(file_, HistoryAccess::kAppend);
  append(history, {knob("oven", 10, "on", "a"), knob("oven", 20, "hot", "b")});
  EXPECT_EQ(settingOf(history.findStateAt("oven", 25)), "hot");
  EXPECT_EQ(history.findLastRecording()->recording, "b");
  append(history, {reverted(knob("oven", 20, "", "b"), KnobSetting{"on"})});
  EXPECT_EQ(settingOf(history.findStateAt("oven", 25)), "on");
  EXPECT_EQ(settingOf(history.findStateAt("oven", 19)), "on");
  EXPECT_EQ(history.findLastRecording()->recording, "a");
  EXPECT_EQ(history.eventsOf("oven").size(), 2U);
  EXPECT_EQ(history.eventsBetween({0, 100}).size(), 2U);
  EXPECT_EQ(history.countBetween(0, 100), 2U);
  const std::vector<Event> second = history.eventsBetween({0, 100, 1, 5});
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].number, history.eventsBetween({0, 100})[1].number);
  EXPECT_EQ(history.eventsBetween({0, 100, 0, 1}).size(), 1U);
  EXPECT_TRUE(history.eventsBetween({0, 100, 2, 1}).empty());
  EXPECT_EQ(history.eventsAfter(0, 100).size(), 3U);  // nothing is ever lost
  append(history, {knob("oven", 21, "warm", "b")});
  EXPECT_EQ(settingOf(history.findStateAt("oven", 25)), "warm");
}

TEST_F(HistoryTest, LastRecordingWithItsSpan) {
  History history(file_, HistoryAccess::kAppend);
  EXPECT_FALSE(history.findLastRecording());
  append(history, {knob("oven", 10, "on", "a"), knob("oven", 30, "on", "a"), knob("oven", 20, "off", "b"), knob("oven", 40, "off")});
  const auto span = history.findLastRecording();
  ASSERT_TRUE(span);
  EXPECT_EQ(span->recording, "a");
  EXPECT_EQ(span->first_ns, 10);
  EXPECT_EQ(span->last_ns, 30);
}

TEST_F(HistoryTest, IsNeverChanged) {
  { append(*std::make_unique<History>(file_, HistoryAccess::kAppend), {knob("oven", 1, "on")}); }
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, "DELETE FROM event", nullptr, nullptr, nullptr), SQLITE_CONSTRAINT);
  EXPECT_EQ(sqlite3_exec(database, "UPDATE event SET subject = 'x'", nullptr, nullptr, nullptr), SQLITE_CONSTRAINT);
  sqlite3_close(database);
}

TEST_F(HistoryTest, AMissingOneReadsAsEmptyUntilItIsThere) {
  const History reader(file_, HistoryAccess::kRead);
  EXPECT_EQ(reader.lastNumber(), 0);
  EXPECT_TRUE(reader.eventsOf("oven").empty());
  EXPECT_FALSE(std::filesystem::exists(file_));
  History writer(file_, HistoryAccess::kAppend);
  EXPECT_EQ(reader.lastNumber(), 0);
  append(writer, {knob("oven", 1, "on")});
  EXPECT_EQ(reader.lastNumber(), 1);  // of a file that another connection writes
}

TEST_F(HistoryTest, RefusesWhatIsNoHistoryOrANewerOne) {
  const auto other = folder_.write("other.sqlite", "this is no database at all, but it is long enough to look at");
  EXPECT_THROW(History(other, HistoryAccess::kAppend), base::Error);
  EXPECT_THROW((void)History(other, HistoryAccess::kRead).lastNumber(), base::Error);
  { const History history(file_, HistoryAccess::kAppend); }
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, "PRAGMA user_version=99", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  try {
    const History history(file_, HistoryAccess::kAppend);
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kInput);
    EXPECT_NE(std::string(error.what()).find("version 99"), std::string::npos);
  }
}

TEST_F(HistoryTest, AFullDiskRefusesTheEventsAndReadsGoOn) {
  History history(file_, HistoryAccess::kAppend);
  append(history, {knob("oven", 1, "on")});
  {
    const test::FileSizeLimit limit(64 * 1024);
    std::vector<Event> many(5000, knob("oven", 2, "off"));
    EXPECT_THROW(append(history, many), base::Error);
    EXPECT_EQ(history.lastNumber(), 1);
    EXPECT_EQ(settingOf(history.findStateAt("oven", 10)), "on");
  }
  append(history, {knob("oven", 3, "warm")});
  EXPECT_EQ(history.lastNumber(), 2);
  EXPECT_EQ(settingOf(history.findStateAt("oven", 10)), "warm");
}

TEST_F(HistoryTest, ManyThreadsAppendAndRead) {
  constexpr int kThreads = 4;
  constexpr int kEach = 50;
  History history(file_, HistoryAccess::kAppend);
  std::vector<std::jthread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < kEach; ++i) {
        append(history, {knob("s" + std::to_string(t), i, "a"), knob("s" + std::to_string(t), i, "b")});
        EXPECT_GE(history.lastNumber(), 2 * (i + 1));
      }
    });
  }
  threads.clear();
  const auto events = history.eventsAfter(0, 100000);
  ASSERT_EQ(events.size(), 2U * kThreads * kEach);
  for (std::size_t i = 0; i < events.size(); i += 2) {
    EXPECT_EQ(events[i].subject, events[i + 1].subject);  // a batch stays together
    EXPECT_EQ(events[i].number, static_cast<std::int64_t>(i) + 1);
  }
}

TEST_F(HistoryTest, KeepsTheLastTwoCheckpoints) {
  History history(file_, HistoryAccess::kAppend);
  EXPECT_TRUE(history.checkpoints().empty());
  for (std::int64_t i = 1; i <= 4; ++i) {
    const History::Checkpoint checkpoint{i, "content " + std::to_string(i)};
    (void)history.append({}, &checkpoint);
  }
  const auto stored = history.checkpoints();
  ASSERT_EQ(stored.size(), 2U);
  EXPECT_EQ(stored[0].as_of, 4);
  EXPECT_EQ(stored[0].content, "content 4");
  EXPECT_EQ(stored[1].content, "content 3");
}

}  // namespace
}  // namespace oikos::semantic
