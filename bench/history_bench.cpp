// SPDX-License-Identifier: Apache-2.0
// What a durable event costs beside a raw 4 KiB write with fdatasync, how many several writers get through, and what a state of the past
// costs by the length of the history.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/base/posix_file.h"
#include "semantic/history/history.h"
#include "semantic/history/home_store.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos;
using Clock = std::chrono::steady_clock;

constexpr const char* kKnob = "fridge-thermostat";
constexpr int kWriters = 8;

double msSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

semantic::Event knobEvent(const std::string& subject, std::int64_t time_ns) {
  semantic::Event event;
  event.subject = subject;
  event.time_ns = time_ns;
  event.kind = semantic::EventKind::kKnob;
  event.after = semantic::KnobSetting{time_ns % 2 == 0 ? "1" : "2"};
  return event;
}

void benchSingleAppend(const std::filesystem::path& folder) {
  constexpr int kTimes = 1000;
  semantic::History history(folder / "single.sqlite", semantic::HistoryAccess::kAppend);
  const base::FileDescriptor raw = base::openFile(folder / "raw", O_WRONLY | O_CREAT);
  const std::string page(4096, 'x');
  std::vector<double> append_ms;
  std::vector<double> raw_ms;
  for (int i = 0; i < kTimes; ++i) {
    auto start = Clock::now();
    if (::write(raw.number(), page.data(), page.size()) < 0 || ::fdatasync(raw.number()) != 0) {
      base::throwErrno("cannot write", folder / "raw");
    }
    raw_ms.push_back(msSince(start));
    start = Clock::now();
    (void)history.append(std::vector{knobEvent(kKnob, i)});
    append_ms.push_back(msSince(start));
  }
  std::printf("%-44s %9s %9s\n", "one at a time, taking turns", "p50, ms", "p99, ms");
  std::printf("%-44s %9.3f %9.3f\n", "4 KiB write and fdatasync", quantile(raw_ms, 0.5), quantile(raw_ms, 0.99));
  std::printf("%-44s %9.3f %9.3f\n", "History::append, one event", quantile(append_ms, 0.5), quantile(append_ms, 0.99));
  std::printf("%-44s %9.2f %9.2f\n\n", "ratio", quantile(append_ms, 0.5) / quantile(raw_ms, 0.5),
              quantile(append_ms, 0.99) / quantile(raw_ms, 0.99));
}

void benchWriters(const std::filesystem::path& source_home, int events_a_call, int calls) {
  const test::TemporaryFolder home;
  std::filesystem::copy_file(source_home / "home.xml", home.path() / "home.xml");
  semantic::HomeStore store(home.path(), [] { return std::int64_t{0}; });
  std::atomic<std::int64_t> clock = 0;  // as observations come: hardly ever older than the newest
  const auto start = Clock::now();
  {
    std::vector<std::jthread> writers;
    for (int w = 0; w < kWriters; ++w) {
      writers.emplace_back([&] {
        for (int i = 0; i < calls; ++i) {
          (void)store.append(std::vector(static_cast<std::size_t>(events_a_call), knobEvent(kKnob, ++clock)));
        }
      });
    }
  }
  const double events_a_second = 1000.0 * kWriters * events_a_call * calls / msSince(start);
  std::printf("%d writers, HomeStore::append of %2d: %9.0f events/s\n", kWriters, events_a_call, events_a_second);
}

void benchStates(const std::filesystem::path& folder, std::int64_t events) {
  constexpr std::int64_t kSubjects = 100;
  constexpr std::int64_t kBatch = 10000;
  constexpr int kTimes = 2001;
  semantic::History history(folder / ("states-" + std::to_string(events) + ".sqlite"), semantic::HistoryAccess::kAppend);
  for (std::int64_t done = 0; done < events;) {
    std::vector<semantic::Event> batch;
    for (; done < events && static_cast<std::int64_t>(batch.size()) < kBatch; ++done) {
      batch.push_back(knobEvent("s" + std::to_string(done % kSubjects), done));
    }
    (void)history.append(batch);
  }
  std::mt19937_64 random(1);
  std::vector<double> times_us;
  for (int i = 0; i < kTimes; ++i) {
    const std::string subject = "s" + std::to_string(random() % kSubjects);
    const auto time_ns = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(events));
    const auto start = Clock::now();
    (void)history.findStateAt(subject, time_ns);
    times_us.push_back(1000.0 * msSince(start));
  }
  std::printf("findStateAt among %8lld events: %6.1f us median, %6.1f us p99\n", static_cast<long long>(events), quantile(times_us, 0.5),
              quantile(times_us, 0.99));
}

}  // namespace

/// `history_bench [HOME]`: the home whose knob is turned; the papers' house from the repository's root.
int main(int argc, char** argv) {
  const std::filesystem::path home = argc > 1 ? argv[1] : "homes/papers";
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const test::TemporaryFolder folder;
  benchSingleAppend(folder.path());
  benchWriters(home, 1, 300);
  benchWriters(home, 8, 200);
  std::printf("\n");
  for (const std::int64_t events : {1000LL, 100000LL, 1000000LL}) {
    benchStates(folder.path(), events);
  }
  return 0;
}
