// SPDX-License-Identifier: Apache-2.0
// What a question costs in process, by the size of the home, and what loading one costs. Of each home three objects are blue cups.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/generated_home.h"
#include "semantic/history/history.h"
#include "semantic/query/answer.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kNow_ns = 1'773'338'400'000'000'000;  // 2026-03-12T18:00:00Z

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double peakMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1000.0;
}

/// The median of many, in microseconds.
double questionUs(const semantic::Inquiry& inquiry, const char* question, int times_asked = 301) {
  std::vector<double> times;
  for (int i = 0; i < times_asked; ++i) {
    const auto start = Clock::now();
    const semantic::Answer answer = semantic::answerQuestion(inquiry, question);
    times.push_back(1e6 * secondsSince(start));
    if (answer.status == semantic::AnswerStatus::kNotUnderstood) {
      std::printf("not understood: %s\n", question);
    }
  }
  std::nth_element(times.begin(), times.begin() + times_asked / 2, times.end());
  return times[static_cast<std::size_t>(times_asked / 2)];
}

/// A thousand of the blue cups, one a minute, the last one two hours ago.
std::vector<semantic::Event> sightings(const semantic::HomeIndex& index) {
  constexpr std::int64_t kMinute_ns = 60'000'000'000;
  constexpr int kEvents = 1000;
  const std::vector<std::uint32_t> cups = index.find({"blue", "cup"}).best();
  std::vector<semantic::Event> events;
  for (int i = 0; i < kEvents; ++i) {
    const semantic::SmallObject& cup = *index.thing(cups[static_cast<std::size_t>(i) % cups.size()]).small_object;
    semantic::Event& event = events.emplace_back();
    event.time_ns = kNow_ns - (120 + kEvents - i) * kMinute_ns;
    event.recording = "drive";
    event.subject = cup.id.value;
    event.after = semantic::Placement{cup.parent, cup.relation, cup.T_parent_object};
  }
  return events;
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
  start = Clock::now();
  const semantic::HomeIndex relinked(index, std::make_shared<const semantic::Home>(reading.home));
  const double relink_ms = 1e3 * secondsSince(start);
  semantic::History history(folder.path() / "history.sqlite", semantic::HistoryAccess::kAppend);
  history.append(sightings(index));
  const semantic::Inquiry present{&index, nullptr, kNow_ns, std::nullopt};
  semantic::Recollection recollection(history);
  const semantic::Inquiry with_history{&index, &history, kNow_ns, std::nullopt, &recollection};
  constexpr int kFew = 11;
  std::printf("| %d | %.1f | %.2f | %.2f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.0f |\n", objects,
              static_cast<double>(std::filesystem::file_size(file)) / 1e6, load_s, index_s, relink_ms,
              questionUs(present, "where is the blue cup?"), questionUs(with_history, "where is the blue cup?"),
              questionUs(present, "what is on the table t7"), questionUs(present, "where is the bleu cup"),
              questionUs(with_history, "where was the blue cup an hour ago", kFew) / 1e3, peakMb());
}

}  // namespace

int main() {
  std::printf(
      "| objects | file MB | load and validate s | index s | index of another state ms | where is the blue cup us | with history us | "
      "what is on the table us | one typing error us | where was the blue cup ms | peak MB so far |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int objects : {1000, 10000, 100000}) {
    measure(objects);
  }
}
