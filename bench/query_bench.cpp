// SPDX-License-Identifier: Apache-2.0
// What a question costs in process, by the size of the home, and what loading one costs. Of each home three objects are blue cups.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/generated_home.h"
#include "semantic/query/answer.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double peakMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1000.0;
}

/// The median of many, in microseconds.
double questionUs(const semantic::HomeIndex& index, const char* question) {
  constexpr int kTimes = 301;
  std::vector<double> times;
  for (int i = 0; i < kTimes; ++i) {
    const auto start = Clock::now();
    const semantic::Answer answer = semantic::answerQuestion(index, question);
    times.push_back(1e6 * secondsSince(start));
    if (answer.status == semantic::AnswerStatus::kNotUnderstood) {
      std::printf("not understood: %s\n", question);
    }
  }
  std::nth_element(times.begin(), times.begin() + kTimes / 2, times.end());
  return times[kTimes / 2];
}

void measure(int objects) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("home.xml", bench::homeXmlOf(objects));
  auto start = Clock::now();
  const semantic::HomeReading reading = semantic::readHome(file);
  const double load_s = secondsSince(start);
  if (!reading.complete || !reading.findings.empty()) {
    std::printf("the generated home is not valid: %s\n", reading.findings.empty() ? "" : reading.findings[0].found.c_str());
    return;
  }
  start = Clock::now();
  const semantic::HomeIndex index(reading.home);
  const double index_s = secondsSince(start);
  std::printf("| %d | %.1f | %.2f | %.2f | %.1f | %.1f | %.1f | %.0f |\n", objects,
              static_cast<double>(std::filesystem::file_size(file)) / 1e6, load_s, index_s, questionUs(index, "where is the blue cup?"),
              questionUs(index, "what is on the table t7"), questionUs(index, "where is the bleu cup"), peakMb());
}

}  // namespace

int main() {
  std::printf(
      "| objects | file MB | load and validate s | index s | where is the blue cup us | what is on the table us | one typing error us | "
      "peak MB so far |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const int objects : {1000, 10000, 100000}) {
    measure(objects);
  }
}
