// SPDX-License-Identifier: Apache-2.0
// The scenario of METHODS S105: short drives through the demo apartment between which doors and drawers are moved, some while they are
// being looked at. After each, what `oikos track` wrote into the home is held against the truth. Drives are simulated, mapped and tracked
// by the program as it is. Each seed is a home of its own, whose furniture differs from what is believed in its own way. What no two images
// show is counted by itself.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/track/scenario.h"
#include "core/base/number_text.h"
#include "core/metrics/share_interval.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos;
namespace fs = std::filesystem;

std::string rate(int hits, int count) {
  const metrics::ShareInterval interval = metrics::wilsonInterval(hits, count);
  return base::toFixedText(100.0 * hits / std::max(1, count), 1) + " % (95 %: " + base::toFixedText(100.0 * interval.low, 1) + "-" +
         base::toFixedText(100.0 * interval.high, 1) + ")";
}

void report(const bench::ScenarioTally& tally) {
  std::printf("state events: found %d of %d, %s; false %d of %d, %s\n", tally.found, tally.expected,
              rate(tally.found, tally.expected).c_str(), tally.false_events, tally.events, rate(tally.false_events, tally.events).c_str());
  std::printf("changes of which fewer than two images show 15 %% of the part: %d, of these found %d\n", tally.hardly_shown,
              tally.hardly_shown_found);
  bench::report(tally.moments, bench::kDriveRate_hz);
  std::printf("recordings without a change missed or an event too many: %d of %d\n", tally.clean, tally.recordings);
  std::printf("%d frames, %.1f frames/s in reading (best recording %.1f), %.1f CPU ms a frame with opening; peak %.0f MB\n", tally.frames,
              tally.frames / tally.seconds, tally.best_rate, 1000.0 * tally.cpu_s / std::max(1, tally.frames), tally.peak_mb);
}

void report(const bench::KnobTally& tally) {
  std::printf("knobs: right after the drive %d of %d that were set anew, %s; false events %d of %d, %s\n", tally.found, tally.expected,
              rate(tally.found, tally.expected).c_str(), tally.false_events, tally.events, rate(tally.false_events, tally.events).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  bench::ScenarioOptions options{.oikos = OIKOS_BUILT_BINARY, .demo_home = OIKOS_DEMO_HOME, .folder = {}};
  int recordings = 12;
  int ovens = 0;
  std::vector<unsigned> seeds = {1};
  fs::path keep;
  CLI::App app("What oikos track makes of short drives between which doors, drawers and knobs are moved", "track_bench");
  app.add_option("--oikos", options.oikos, "the program to run")->check(CLI::ExistingFile);
  app.add_option("--recordings", recordings, "drives of each home; four routes take turns")->check(CLI::Range(0, 300));
  app.add_option("--ovens", ovens, "drives up to the oven of each home, whose knobs are turned")->check(CLI::Range(0, 100));
  app.add_option("--belief-mm", options.belief_mm, "standard deviation of believed dimensions and places");
  app.add_option("--threads", options.threads);
  app.add_option("--seed", seeds, "one home each");
  app.add_option("--keep", keep, "a folder to work in, which stays; maps and drives that are in it are used again");
  app.add_option("--set", options.settings, "KEY=VALUE for oikos track; may be repeated")->allow_extra_args(false);
  CLI11_PARSE(app, argc, argv);
  try {
    bench::ScenarioTally tally;
    bench::KnobTally knobs;
    for (const unsigned seed : seeds) {
      const test::TemporaryFolder folder;
      options.folder = (keep.empty() ? folder.path() : keep) / ("seed-" + std::to_string(seed));
      options.seed = seed;
      bench::Scenario scenario(options);
      for (int recording = 0; recording < recordings; ++recording) {
        scenario.run(recording, tally);
      }
      for (int oven = 0; oven < ovens; ++oven) {
        scenario.runOven(recordings + oven, knobs);
      }
    }
    if (recordings > 0) {
      report(tally);
    }
    if (ovens > 0) {
      report(knobs);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "track_bench: %s\n", error.what());
    return 1;
  }
}
