// SPDX-License-Identifier: Apache-2.0
// A history where nothing may be written: by another user's process, since permissions do not hold the tests' own user back.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "core/base/error.h"
#include "semantic/history/history.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

class ReadOnlyHistoryTest : public testing::Test {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) {
      GTEST_SKIP() << "SKIPPED: a history that may not be written was NOT tested: only root can become another user";
    }
    GTEST_FLAG_SET(death_test_style, "fast");
    using std::filesystem::perms;
    std::filesystem::permissions(folder_.path(),
                                 perms::owner_all | perms::group_read | perms::group_exec | perms::others_read | perms::others_exec);
  }

  static Event knob(std::int64_t time_ns) {
    Event event;
    event.subject = "oven";
    event.time_ns = time_ns;
    event.kind = EventKind::kKnob;
    event.after = KnobSetting{"on"};
    return event;
  }
  void append(History& history) const {
    const Event event = knob(history.lastNumber() + 1);
    (void)history.append({&event, 1});
  }

  /// What `said` returns or throws, in a process that may read only; it says that and ends.
  [[noreturn]] static void sayAsAnother(const std::function<std::string()>& said) {
    if (::seteuid(65534) != 0) {
      std::exit(2);
    }
    std::string text;
    try {
      text = said();
    } catch (const base::Error& error) {
      text = error.what();
    }
    std::fputs(text.c_str(), stderr);
    std::_Exit(0);  // at an ordinary end a leak checker would attach itself to the process, which another user's may not
  }
  [[nodiscard]] std::string lastNumber() const { return "last " + std::to_string(History(file_, HistoryAccess::kRead).lastNumber()); }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "history.sqlite";
};

TEST_F(ReadOnlyHistoryTest, IsReadAfterItWasClosed) {
  {
    History history(file_, HistoryAccess::kAppend);
    append(history);
    append(history);
  }
  EXPECT_EXIT(sayAsAnother([&] { return lastNumber(); }), testing::ExitedWithCode(0), "last 2");
}

TEST_F(ReadOnlyHistoryTest, IsReadWhileAnotherProcessWritesIt) {
  int done[2];
  int ready[2];
  ASSERT_EQ(::pipe(done), 0);
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t writer = ::fork();  // SQLite takes no connection across a fork: what forks the reader must have none
  if (writer == 0) {
    ::close(done[1]);
    History history(file_, HistoryAccess::kAppend);
    append(history);
    char byte = 0;
    ::_exit(::write(ready[1], &byte, 1) == 1 && ::read(done[0], &byte, 1) == 0 ? 0 : 1);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_EXIT(sayAsAnother([&] { return lastNumber(); }), testing::ExitedWithCode(0), "last 1");
  for (const int end : {done[0], done[1], ready[0], ready[1]}) {
    ::close(end);
  }
  int status = -1;
  EXPECT_EQ(::waitpid(writer, &status, 0), writer);
  EXPECT_EQ(status, 0);
}

TEST_F(ReadOnlyHistoryTest, SaysThatItMayNotBeWritten) {
  {
    History history(file_, HistoryAccess::kAppend);
    append(history);
  }
  const auto open = [&] {
    (void)History(file_, HistoryAccess::kAppend);
    return std::string("opened");
  };
  EXPECT_EXIT(sayAsAnother(open), testing::ExitedWithCode(0), "history.sqlite: may not be written");
  EXPECT_EQ(lastNumber(), "last 1");
}

TEST_F(ReadOnlyHistoryTest, NeverPassesOverWhatAKilledWriterLeftInTheLog) {
  const auto copy = folder_.path() / "copy.sqlite";
  {
    History history(file_, HistoryAccess::kAppend);
    append(history);
    std::filesystem::copy(file_, copy);
    std::filesystem::copy(file_.string() + "-wal", copy.string() + "-wal");
  }
  file_ = copy;
  EXPECT_EXIT(sayAsAnother([&] { return lastNumber(); }), testing::ExitedWithCode(0),
              "copy.sqlite-wal: what came last is still in this log");
  EXPECT_EQ(lastNumber(), "last 1");
}

}  // namespace
}  // namespace oikos::semantic
