// SPDX-License-Identifier: Apache-2.0
// What was acknowledged survives a power cut at any moment.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "semantic/history/history.h"
#include "tests/support/power_cut_vfs.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

constexpr int kBatches = 40;
constexpr std::int64_t kBatchSize = 3;
constexpr std::int64_t kCuts = 220;
constexpr std::int64_t kCutsWhileMade = 40;  // each of them is tried
constexpr std::int64_t kGoOnEach = 10;       // it costs real syncs
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

std::vector<Event> batch(int number) {
  std::vector<Event> events(kBatchSize);
  for (std::int64_t i = 0; i < kBatchSize; ++i) {
    Event& event = events[i];
    event.subject = "s" + std::to_string(number % 5);
    event.time_ns = number * kBatchSize + i + 1;
    event.kind = EventKind::kKnob;
    event.after = KnobSetting{std::string(200, 'x')};
  }
  return events;
}

/// Appends until all is written or the power is gone: the number of the last event that was acknowledged.
std::int64_t appendUntilCut(const std::filesystem::path& file) {
  std::int64_t acknowledged = 0;
  try {
    History history(file, HistoryAccess::kAppend);
    for (int b = 0; b < kBatches; ++b) {
      const History::Checkpoint checkpoint{acknowledged, std::string(5000, 'c')};
      acknowledged = history.append(batch(b), b % 8 == 7 ? &checkpoint : nullptr);
    }
  } catch (const base::Error&) {  // the power is gone
  }
  return acknowledged;
}

std::int64_t operationsOfAll() {
  const test::TemporaryFolder folder;
  test::PowerCutVfs disk(kNever);
  EXPECT_EQ(appendUntilCut(folder.path() / "history.sqlite"), kBatches * kBatchSize);
  return disk.operations();
}

void expectWholeBatches(const std::vector<Event>& events, std::int64_t acknowledged, std::int64_t cut) {
  const auto count = static_cast<std::int64_t>(events.size());
  EXPECT_GE(count, acknowledged) << "cut after " << cut;
  EXPECT_LE(count, acknowledged + kBatchSize) << "cut after " << cut;
  EXPECT_EQ(count % kBatchSize, 0) << "cut after " << cut;
  for (std::int64_t i = 0; i < count; ++i) {
    ASSERT_EQ(events[i].number, i + 1) << "cut after " << cut;
    ASSERT_EQ(events[i].time_ns, i + 1) << "cut after " << cut;
  }
}

TEST(PowerCut, NoAcknowledgedEventIsLostAndNoBatchIsHalfThere) {
  const std::int64_t operations = operationsOfAll();
  ASSERT_GT(operations, kCuts);
  std::int64_t acknowledged_in_all = 0;
  for (std::int64_t i = 0; i < kCuts; ++i) {
    const std::int64_t cut = i < kCutsWhileMade ? 1 + i : 1 + i * (operations - 1) / kCuts;
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "history.sqlite";
    std::int64_t acknowledged = 0;
    {
      test::PowerCutVfs disk(cut);
      acknowledged = appendUntilCut(file);
      EXPECT_TRUE(disk.isCut());
      disk.restore();
    }
    acknowledged_in_all += acknowledged;
    if (i % 2 == 0) {  // a reader may be the first to come, too
      EXPECT_GE(History(file, HistoryAccess::kRead).lastNumber(), acknowledged) << "cut after " << cut;
    }
    History history(file, HistoryAccess::kAppend);
    expectWholeBatches(history.eventsAfter(0, 100000), acknowledged, cut);
    if (i % kGoOnEach == 0) {
      const std::int64_t number = history.append(batch(0));
      EXPECT_EQ(number, history.lastNumber());
      EXPECT_LE(history.checkpoints().size(), 2U);
    }
  }
  EXPECT_GT(acknowledged_in_all, kCuts * kBatchSize);
}

class RawConnection {
 public:
  explicit RawConnection(const std::filesystem::path& file) { EXPECT_EQ(sqlite3_open(file.c_str(), &database_), SQLITE_OK); }
  ~RawConnection() { sqlite3_close(database_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  bool run(const std::string& sql) { return sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK; }
  int count() {
    int rows = -1;
    const auto take = [](void* out, int, char** values, char**) {
      *static_cast<int*>(out) = std::stoi(values[0]);
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(database_, "SELECT count(*) FROM t", take, &rows, nullptr), SQLITE_OK);
    return rows;
  }

 private:
  sqlite3* database_ = nullptr;
};

/// Rows that were acknowledged and are gone after a cut among the inserts.
int rowsLost(const std::string& synchronous) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "t.sqlite";
  { EXPECT_TRUE(RawConnection(file).run("PRAGMA journal_mode=WAL; CREATE TABLE t(x)")); }
  int acknowledged = 0;
  {
    test::PowerCutVfs disk(100);
    {
      RawConnection writer(file);
      EXPECT_TRUE(writer.run("PRAGMA synchronous=" + synchronous));
      while (!disk.isCut()) {
        acknowledged += writer.run("INSERT INTO t VALUES(zeroblob(300))") ? 1 : 0;
      }
    }
    disk.restore();
  }
  EXPECT_GT(acknowledged, 10);
  return acknowledged - RawConnection(file).count();
}

TEST(PowerCutVfs, ThrowsAwayWhatWasNotSynced) {
  EXPECT_LE(rowsLost("FULL"), 0);
  EXPECT_GT(rowsLost("OFF"), 0);
  EXPECT_GT(rowsLost("NORMAL"), 0);  // a WAL is synced at its checkpoints only
}

}  // namespace
}  // namespace oikos::semantic
