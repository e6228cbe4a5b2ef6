// SPDX-License-Identifier: Apache-2.0
// A recording that was read to its end is known by its content.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <string>
#include <vector>

#include "core/base/error.h"
#include "semantic/history/history.h"
#include "semantic/history/revert.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

Event opened(const std::string& recording, double value) {
  Event event;
  event.time_ns = 7;
  event.recording = recording;
  event.subject = "door-joint";
  event.kind = EventKind::kJoint;
  event.after = JointValue{JointType::kRevolute, value};
  return event;
}

class ReadRecording : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "history.sqlite";
};

TEST_F(ReadRecording, CountsOnceUnderWhateverName) {
  History history(file_, HistoryAccess::kAppend);
  EXPECT_FALSE(history.findReadRecording("d1"));
  const std::vector<Event> events = {opened("monday", 1.0), opened("monday", 0.0)};
  EXPECT_EQ(history.appendRecording({"d1", "monday", 5, 9}, events), 2);
  EXPECT_EQ(history.appendRecording({"d1", "copy", 5, 9}, events), std::nullopt);
  EXPECT_EQ(history.lastNumber(), 2);
  ASSERT_TRUE(history.findReadRecording("d1"));
  EXPECT_EQ(history.findReadRecording("d1")->recording, "monday");
  EXPECT_TRUE(history.findReadRecording("d1")->counts);
}

TEST_F(ReadRecording, OneThatChangesNothingIsKnownToo) {
  History history(file_, HistoryAccess::kAppend);
  EXPECT_EQ(history.appendRecording({"quiet", "tuesday", 20, 30}, {}), 0);
  EXPECT_EQ(history.appendRecording({"quiet", "tuesday", 20, 30}, {}), std::nullopt);
  EXPECT_EQ(history.appendRecording({"other", "wednesday", 40, 50}, {}), 0);
}

TEST_F(ReadRecording, IsSharedByProcesses) {
  History one(file_, HistoryAccess::kAppend);
  History other(file_, HistoryAccess::kAppend);
  const std::vector<Event> events = {opened("monday", 1.0)};
  EXPECT_EQ(one.appendRecording({"d1", "monday", 5, 9}, events), 1);
  EXPECT_EQ(other.appendRecording({"d1", "monday", 5, 9}, events), std::nullopt);
  EXPECT_EQ(other.lastNumber(), 1);
}

TEST_F(ReadRecording, MayBeReadAgainOnceItWasTakenBack) {
  History history(file_, HistoryAccess::kAppend);
  const std::vector<Event> events = {opened("monday", 1.0)};
  ASSERT_EQ(history.appendRecording({"d1", "monday", 5, 9}, events), 1);
  ASSERT_EQ(revertRecording(history, "monday").events, 1);
  ASSERT_TRUE(history.findReadRecording("d1"));
  EXPECT_EQ(history.findReadRecording("d1")->recording, "monday");
  EXPECT_FALSE(history.findReadRecording("d1")->counts);
  EXPECT_EQ(history.appendRecording({"d1", "monday", 5, 9}, events), 3);
  EXPECT_TRUE(history.findReadRecording("d1")->counts);
  EXPECT_EQ(history.eventsOfRecording("monday").size(), 1U);
}

TEST_F(ReadRecording, AnOlderProgramsHistoryLearnsIt) {
  { const History history(file_, HistoryAccess::kAppend); }
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, "DROP TABLE tracked_recording", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  EXPECT_EQ(History(file_, HistoryAccess::kRead).lastNumber(), 0);
  History history(file_, HistoryAccess::kAppend);
  EXPECT_EQ(history.appendRecording({"d1", "monday", 5, 9}, {}), 0);
}

TEST_F(ReadRecording, TheLastOneIsTheLastEvenIfItChangedNothing) {
  History history(file_, HistoryAccess::kAppend);
  EXPECT_FALSE(history.findLastRecording());
  const std::vector<Event> events = {opened("monday", 1.0)};
  history.appendRecording({"d1", "monday", 5, 9}, events);
  ASSERT_TRUE(history.findLastRecording());
  EXPECT_EQ(history.findLastRecording()->recording, "monday");
  EXPECT_EQ(history.findLastRecording()->first_ns, 5);  // of its first frame; its event is at 7
  EXPECT_EQ(history.findLastRecording()->last_ns, 9);
  history.appendRecording({"quiet", "tuesday", 20, 30}, {});
  history.appendRecording({"early", "sunday", 1, 2}, {});
  for (const HistoryAccess access : {HistoryAccess::kAppend, HistoryAccess::kRead}) {
    const auto last = History(file_, access).findLastRecording();
    ASSERT_TRUE(last);
    EXPECT_EQ(last->recording, "tuesday");
    EXPECT_EQ(last->first_ns, 20);
    EXPECT_EQ(last->last_ns, 30);
  }
  ASSERT_EQ(revertRecording(history, "monday").events, 1);
  EXPECT_EQ(history.findLastRecording()->recording, "tuesday");
}

TEST_F(ReadRecording, OneThatWasTakenBackIsNotTheLast) {
  History history(file_, HistoryAccess::kAppend);
  const std::vector<Event> events = {opened("monday", 1.0)};
  history.appendRecording({"quiet", "sunday", 1, 2}, {});
  history.appendRecording({"d1", "monday", 5, 9}, events);
  ASSERT_EQ(revertRecording(history, "monday").events, 1);
  EXPECT_EQ(history.findLastRecording()->recording, "sunday");
}

TEST_F(ReadRecording, WhereNothingMayBeWrittenIsAContract) {
  { const History history(file_, HistoryAccess::kAppend); }
  History history(file_, HistoryAccess::kRead);
  EXPECT_THROW((void)history.appendRecording({"d1", "monday", 5, 9}, {}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::semantic
