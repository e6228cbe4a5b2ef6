// SPDX-License-Identifier: Apache-2.0
// What SQLite means to do for each question to a history, with many events in it.
#include "semantic/history/history_sql.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <string>
#include <vector>

#include "core/base/error.h"
#include "semantic/history/history.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

class HistorySqlTest : public testing::Test {
 protected:
  HistorySqlTest() {
    History history(file_, HistoryAccess::kAppend);
    std::vector<Event> events(3000);
    for (std::size_t i = 0; i < events.size(); ++i) {
      events[i].subject = "s" + std::to_string(i % 7);
      events[i].time_ns = static_cast<std::int64_t>(i);
      events[i].recording = i % 3 == 0 ? "" : "r" + std::to_string(i / 100);
      events[i].kind = i % 50 == 0 ? EventKind::kSighted : EventKind::kKnob;
      events[i].after = KnobSetting{"on"};
    }
    (void)history.append(events);
  }

  /// A line a step.
  [[nodiscard]] std::string planOf(const std::string& sql) const {
    SqliteDatabase database(file_, SqliteDatabase::Mode::kRead);
    SqliteStatement plan(database, "EXPLAIN QUERY PLAN " + sql);
    std::string lines;
    while (plan.step()) {
      lines += plan.text(3) + "\n";
    }
    return lines;
  }

  void expectSearch(const std::string& sql, const std::string& how) const {
    const std::string plan = planOf(sql);
    EXPECT_TRUE(plan.starts_with("SEARCH e USING " + how)) << plan;
    EXPECT_EQ(plan.find("SCAN"), std::string::npos) << plan;
    EXPECT_EQ(plan.find("TEMP B-TREE"), std::string::npos) << plan;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "history.sqlite";
};

TEST_F(HistorySqlTest, EveryQuestionIsALookIntoAnIndex) {
  EXPECT_EQ(planOf(history_sql::lastNumber()), "SEARCH e\n");  // the last row
  expectSearch(history_sql::eventsAfter(), "INTEGER PRIMARY KEY (rowid>?)");
  expectSearch(history_sql::eventsOf(), "INDEX event_of_subject (subject=?)");
  expectSearch(history_sql::lastEventsOf(), "INDEX event_of_subject (subject=? AND time_ns<?)");
  expectSearch(history_sql::eventsBetween(), "INDEX event_of_time (time_ns>? AND time_ns<?)");
  expectSearch(history_sql::countBetween(), "INDEX event_of_time (time_ns>? AND time_ns<?)");
  expectSearch(history_sql::stateAt(), "INDEX state_of_subject (subject=? AND time_ns<?)");
  expectSearch(history_sql::stateAfter(), "INDEX state_of_subject (subject=? AND time_ns>?)");
  expectSearch(history_sql::sightingAt(), "INDEX sighting_of_subject (subject=? AND time_ns<?)");
  expectSearch(history_sql::stateWithout(), "INDEX state_of_subject (subject=?)");
  expectSearch(history_sql::nextSubject(), "INDEX state_of_subject (subject>?)");
  expectSearch(history_sql::nextRecording(), "COVERING INDEX event_of_recording (recording>?)");
  expectSearch(history_sql::spanOfRecording(), "INDEX event_of_recording (recording=?)");
}

TEST_F(HistorySqlTest, AFileOfAProgramBeforeGetsTheNewerIndex) {
  {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file_.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, "DROP INDEX sighting_of_subject", nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  }
  EXPECT_EQ(History(file_, HistoryAccess::kRead).findSightingAt("s0", 2999)->time_ns, 2800);  // slower, but right
  EXPECT_EQ(planOf(history_sql::sightingAt()).find("sighting_of_subject"), std::string::npos);
  EXPECT_EQ(History(file_, HistoryAccess::kAppend).findSightingAt("s0", 2999)->time_ns, 2800);
  expectSearch(history_sql::sightingAt(), "INDEX sighting_of_subject");
}

}  // namespace
}  // namespace oikos::semantic
