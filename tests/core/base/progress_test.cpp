// SPDX-License-Identifier: Apache-2.0
#include "core/base/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <string>

namespace oikos::base {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(FormatProgress, ShowsShareRateAndTimeLeft) {
  EXPECT_EQ(formatProgress({"mapping", 300, 600}, 10.0, 80), "mapping [############............]  50%  300/600  30.0/s  0:10 left");
  EXPECT_EQ(formatProgress({"mapping", 600, 600}, 20.0, 80), "mapping [########################] 100%  600/600  30.0/s  0:00 left");
  EXPECT_EQ(formatProgress({"mapping", 1, 3601}, 1.0, 80), "mapping [........................]   0%  1/3601  1.0/s  1:00:00 left");
}

TEST(FormatProgress, WaitsWithRateUntilThereIsABasis) {
  EXPECT_EQ(formatProgress({"mapping", 0, 10}, 5.0, 80), "mapping [........................]   0%  0/10");
  EXPECT_EQ(formatProgress({"mapping", 1, 10}, 0.1, 80), "mapping [##......................]  10%  1/10");
}

TEST(FormatProgress, CountsWhenTheTotalIsNotKnown) {
  EXPECT_EQ(formatProgress({"reading", 7, 0}, 2.0, 80), "reading  7  3.5/s");
}

TEST(FormatProgress, NeverSaysAHundredPercentTooEarly) {
  EXPECT_NE(formatProgress({"x", 9999, 10000}, 0.0, 80).find(" 99%"), std::string::npos);
}

TEST(FormatProgress, FitsItsColumnsAndClampsNonsense) {
  EXPECT_EQ(formatProgress({"mapping", 300, 600}, 10.0, 10), "mapping [#");
  EXPECT_EQ(formatProgress({"x", 12, 10}, 0.0, 80), "x [########################] 100%  10/10");
  EXPECT_EQ(formatProgress({"x", -1, -1}, 0.0, 80), "x  0");
}

TEST(ProgressBar, RedrawsAtMostTenTimesASecondButAlwaysTheEnd) {
  std::chrono::steady_clock::time_point now;
  std::ostringstream terminal;
  ProgressBar bar(terminal, 80, [&now] { return now; });
  bar.show({"mapping", 1, 3});
  now += milliseconds(50);
  bar.show({"mapping", 2, 3});
  EXPECT_EQ(terminal.str().find("2/3"), std::string::npos);
  bar.show({"mapping", 3, 3});
  EXPECT_NE(terminal.str().find("3/3"), std::string::npos);
}

TEST(ProgressBar, RateStartsAnewWithEachStage) {
  std::chrono::steady_clock::time_point now;
  std::ostringstream terminal;
  ProgressBar bar(terminal, 80, [&now] { return now; });
  bar.show({"reading", 0, 10});
  now += seconds(100);
  bar.show({"mapping", 0, 10});
  now += seconds(1);
  bar.show({"mapping", 5, 10});
  EXPECT_NE(terminal.str().find("5/10  5.0/s  0:01 left"), std::string::npos) << terminal.str();
}

TEST(ProgressBar, ClearLeavesAnEmptyLineOnce) {
  std::ostringstream terminal;
  ProgressBar bar(terminal);
  bar.clear();
  EXPECT_EQ(terminal.str(), "");
  bar.show({"x", 1, 2});
  bar.clear();
  EXPECT_TRUE(terminal.str().ends_with("\r\x1b[K"));
  const std::string cleared = terminal.str();
  bar.clear();
  EXPECT_EQ(terminal.str(), cleared);
}

TEST(ReportProgress, AcceptsThatNobodyListens) {
  reportProgress({}, {"x", 1, 2});
  int calls = 0;
  reportProgress([&calls](const Progress& progress) { calls += progress.done; }, {"x", 3, 4});
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace oikos::base
