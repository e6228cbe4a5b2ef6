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
  EXPECT_EQ(history.appendRecording({"d1", "monday"}, events), 2);
  EXPECT_EQ(history.appendRecording({"d1", "copy"}, events), std::nullopt);
  EXPECT_EQ(history.lastNumber(), 2);
  ASSERT_TRUE(history.findReadRecording("d1"));
  EXPECT_EQ(history.findReadRecording("d1")->recording, "monday");
  EXPECT_TRUE(history.findReadRecording("d1")->counts);
}

TEST_F(ReadRecording, OneThatChangesNothingIsKnownToo) {
  History history(file_, HistoryAccess::kAppend);
  EXPECT_EQ(history.appendRecording({"quiet", "tuesday"}, {}), 0);
  EXPECT_EQ(history.appendRecording({"quiet", "tuesday"}, {}), std::nullopt);
  EXPECT_EQ(history.appendRecording({"other", "wednesday"}, {}), 0);
}

TEST_F(ReadRecording, IsSharedByProcesses) {
  History one(file_, HistoryAccess::kAppend);
  History other(file_, HistoryAccess::kAppend);
  const std::vector<Event> events = {opened("monday", 1.0)};
  EXPECT_EQ(one.appendRecording({"d1", "monday"}, events), 1);
  EXPECT_EQ(other.appendRecording({"d1", "monday"}, events), std::nullopt);
  EXPECT_EQ(other.lastNumber(), 1);
}

TEST_F(ReadRecording, MayBeReadAgainOnceItWasTakenBack) {
  History history(file_, HistoryAccess::kAppend);
  const std::vector<Event> events = {opened("monday", 1.0)};
  ASSERT_EQ(history.appendRecording({"d1", "monday"}, events), 1);
  ASSERT_EQ(revertRecording(history, "monday").events, 1);
  ASSERT_TRUE(history.findReadRecording("d1"));
  EXPECT_EQ(history.findReadRecording("d1")->recording, "monday");
  EXPECT_FALSE(history.findReadRecording("d1")->counts);
  EXPECT_EQ(history.appendRecording({"d1", "monday"}, events), 3);
  EXPECT_TRUE(history.findReadRecording("d1")->counts);
  EXPECT_EQ(history.eventsOfRecording("monday").size(), 1U);
}

TEST_F(ReadRecording, AnOlderProgramsHistoryLearnsIt) {
  { const History history(file_, HistoryAccess::kAppend); }
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, "DROP TABLE read_recording", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  EXPECT_EQ(History(file_, HistoryAccess::kRead).lastNumber(), 0);
  History history(file_, HistoryAccess::kAppend);
  EXPECT_EQ(history.appendRecording({"d1", "monday"}, {}), 0);
}

TEST_F(ReadRecording, WhereNothingMayBeWrittenIsAContract) {
  { const History history(file_, HistoryAccess::kAppend); }
  History history(file_, HistoryAccess::kRead);
  EXPECT_THROW((void)history.appendRecording({"d1", "monday"}, {}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::semantic
