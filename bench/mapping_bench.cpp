// SPDX-License-Identifier: Apache-2.0
// Accuracy, speed and memory of `oikos map` on real recordings, one configuration for all; and whether runs give the same bytes.
//   mapping_bench [--recording NAME]… [--threads N] [--repeat N] [--oikos PATH] [--set KEY=VALUE]…
// The recordings are those of OIKOS_DATA and variants of them (bench/mapping/bench_recording.h); NAME can also be `determinism`. Trajectory
// errors are after alignment by a rigid motion, never scale; every frame counts, lost ones with the pose that they were given.
#include <stdlib.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bench/mapping/bars.h"
#include "bench/mapping/bench_recording.h"
#include "bench/mapping/mapping_run.h"
#include "bench/mapping/mapping_score.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos::bench;

constexpr const char* kDeterminism = "determinism";
const std::vector<std::string> kComparedRecordings{"kitchen", "desk-rpy"};

struct Options {
  std::vector<std::string> recordings;
  int repeat = 1;
  MapCommand command{OIKOS_BUILT_BINARY, 0, {}};
};

std::string processorName() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("model name")) {
      return line.substr(line.find(':') + 2);
    }
  }
  return "unknown processor";
}

void printMachine(const Options& options) {
  char date[16] = "";
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%F", std::gmtime(&now));
  double load[1] = {0.0};
  (void)getloadavg(load, 1);
  std::printf("%s, %s, %u processors, load %.1f at the start\n", date, processorName().c_str(), std::thread::hardware_concurrency(),
              load[0]);
  std::printf("%s threads, best of %d", options.command.threads > 0 ? std::to_string(options.command.threads).c_str() : "default",
              options.repeat);
  for (const std::string& setting : options.command.settings) {
    std::printf(", %s", setting.c_str());
  }
  std::printf("\n");
}

MappingScore mapAndScore(const Options& options, const BenchRecording& recording, const std::filesystem::path& scratch) {
  const auto home = scratch / (recording.name + "-home");
  std::vector<ChildRun> runs;
  for (int i = 0; i < options.repeat; ++i) {
    std::filesystem::remove_all(home);
    runs.push_back(mapRecording(options.command, recording.folder, home));
  }
  MappingScore score = scoreRuns(recording, runs, home);
  std::filesystem::remove_all(home);
  return score;
}

/// Says so loudly if the recording is not there.
bool isThere(const std::string& name, const std::filesystem::path& data) {
  const auto folder = sourceFolder(name, data);
  if (std::filesystem::is_directory(folder)) {
    return true;
  }
  std::printf("SKIPPED: %s, there is no %s\n", name.c_str(), folder.c_str());
  return false;
}

bool compareAll(const Options& options, const std::filesystem::path& data, const std::filesystem::path& scratch) {
  std::printf("\nTwo runs, and 1, 2, 3 threads: every file but timing.json\n");
  bool all_same = true;
  for (const std::string& name : kComparedRecordings) {
    if (isThere(name, data)) {
      all_same = compareRuns(options.command, prepareRecording(name, data, scratch), scratch) && all_same;
    }
  }
  return all_same;
}

/// Returns whether what must never differ does not; accuracy and speed are for the reader to judge.
bool run(const Options& options, const std::filesystem::path& data) {
  const oikos::test::TemporaryFolder scratch;
  printMachine(options);
  Scores scores;
  double least_peak_mb = 1e9;
  for (const std::string& name : options.recordings) {
    if (name != kDeterminism && isThere(name, data)) {
      std::fprintf(stderr, "mapping %s\n", name.c_str());
      scores[name] = mapAndScore(options, prepareRecording(name, data, scratch.path()), scratch.path());
      least_peak_mb = std::min(least_peak_mb, scores[name].peak_mb);
    }
  }
  if (!scores.empty()) {
    printScores(scores);
    printBars(scores);
    if (ownPeakMb() >= least_peak_mb) {
      std::printf("\npeaks below %.0f MB cannot be told: the bench itself held as much\n", ownPeakMb());
    }
  }
  return std::ranges::count(options.recordings, kDeterminism) == 0 || compareAll(options, data, scratch.path());
}

Options parse(CLI::App& app, int argc, char** argv) {
  Options options;
  std::vector<std::string> names = benchRecordingNames();
  names.push_back(kDeterminism);
  options.recordings = names;
  app.add_option("--recording", options.recordings, "what to run; default: all")->check(CLI::IsMember(names));
  app.add_option("--threads", options.command.threads, "of oikos map")->check(CLI::NonNegativeNumber);
  app.add_option("--repeat", options.repeat, "runs of each")->check(CLI::PositiveNumber);
  app.add_option("--oikos", options.command.oikos, "the program to run")->check(CLI::ExistingFile);
  app.add_option("--set", options.command.settings, "KEY=VALUE for oikos map; may be repeated");
  app.parse(argc, argv);
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Accuracy, speed and memory of oikos map on the recordings in OIKOS_DATA", "mapping_bench");
  try {
    const Options options = parse(app, argc, argv);
    const char* const data = std::getenv("OIKOS_DATA");
    if (data == nullptr || !std::filesystem::is_directory(data)) {
      std::printf("SKIPPED: mapping_bench needs real recordings: set OIKOS_DATA to a folder with kitchen, desk-rpy, household-box\n");
      return 0;
    }
    return run(options, data) ? 0 : 1;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mapping_bench: %s\n", error.what());
    return 1;
  }
}
