// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/mapping/bench_recording.h"
#include "bench/mapping/child_process.h"

namespace oikos::bench {

/// How `oikos map` is run.
struct MapCommand {
  std::filesystem::path oikos;        ///< the program
  int threads = 0;                    ///< 0: the program's default
  std::vector<std::string> settings;  ///< KEY=VALUE, given with --set
};

/// Runs `oikos map` as a program of its own; `home` is made or replaced. Throws std::runtime_error if it fails.
[[nodiscard]] ChildRun mapRecording(const MapCommand& command, const std::filesystem::path& recording, const std::filesystem::path& home);

/// 64-bit FNV-1a of each file's bytes, by its path in the home; without `map/timing.json`, the one file that may differ between runs.
[[nodiscard]] std::map<std::string, std::uint64_t> hashFiles(const std::filesystem::path& home);

/// Maps the recording twice with the default and with 1, 2 and 3 threads, and prints which files differ from the first run's.
/// Returns whether none does.
bool compareRuns(const MapCommand& command, const BenchRecording& recording, const std::filesystem::path& scratch);

}  // namespace oikos::bench
