// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/access_log.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "core/base/read_file.h"
#include "tests/support/temporary_folder.h"

namespace oikos::daemon {
namespace {

constexpr std::int64_t kNoon_ns = 1'700'000'000'500'000'000;

TEST(AccessLog, ALineSaysWhoAskedForWhatAndWhatCameOfIt) {
  const Request request{"GET", "/v1/ask?q=where", "", "Bearer secret", "", "", "127.0.0.1"};
  EXPECT_EQ(accessLine({request, 200, 512, std::chrono::microseconds(1250)}, kNoon_ns),
            "2023-11-14T22:13:20.5Z 127.0.0.1 \"GET /v1/ask?q=where\" 200 512 1.250");
}

TEST(AccessLog, ALineCannotBeForged) {
  const Request request{"G\"T", "/a\n2023 \"\x1b[31m\\\xff", "", "", "", "", "::1"};
  EXPECT_EQ(accessLine({request, 400, 0, {}}, kNoon_ns),
            "2023-11-14T22:13:20.5Z ::1 \"G\\x22T /a\\x0a2023 \\x22\\x1b[31m\\x5c\\xff\" 400 0 0.000");
  const Request endless{"GET", "/" + std::string(9999, 'a'), "", "", "", "", "::1"};
  EXPECT_LT(accessLine({endless, 414, 0, {}}, kNoon_ns).size(), 1200U);
}

TEST(AccessLog, WritesEveryLineBeforeItEnds) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "log";
  {
    AccessLog log(base::openFile(file, O_WRONLY | O_CREAT | O_APPEND));
    for (int i = 0; i < 1000; ++i) {
      log.add("line " + std::to_string(i));
    }
  }
  const std::string text = base::readFile(file);
  EXPECT_TRUE(text.starts_with("line 0\nline 1\n"));
  EXPECT_TRUE(text.ends_with("line 999\n"));
}

TEST(AccessLog, DropsAndCountsWhatAStuckReaderLeavesNoRoomFor) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  base::FileDescriptor reader(ends[0]);
  AccessLog log{base::FileDescriptor(ends[1])};
  const std::string line(1000, 'x');
  for (int i = 0; i < 5000; ++i) {  // five megabytes into a pipe of 64 KiB that nobody reads
    log.add(line);
  }
  EXPECT_GT(log.dropped(), 1500);
  std::signal(SIGPIPE, SIG_IGN);
  { const base::FileDescriptor closed(std::move(reader)); }  // the writer is let go on
}

}  // namespace
}  // namespace oikos::daemon
