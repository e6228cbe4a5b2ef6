// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/mapping/bench_recording.h"
#include "bench/mapping/child_process.h"
#include "core/metrics/trajectory_error.h"

namespace oikos::bench {

/// What one recording's map is like and what it took.
struct MappingScore {
  std::string name;
  int frames = 0;
  int poses = 0;  ///< of these, frames that have one
  int lost = 0;   ///< of these, frames whose pose is borrowed
  int keyframes = 0;
  int loops = 0;
  metrics::TrajectoryError error;
  double first_aligned_max_m = 0.0;  ///< largest position error with the first frame's pose laid on the truth, nothing else aligned
  std::vector<double> wall_s;        ///< of each run, ascending
  double cpu_s = 0.0;                ///< of the run with the least
  double peak_mb = 0.0;              ///< of the run with the most

  [[nodiscard]] double bestFps() const { return frames / wall_s.front(); }
  [[nodiscard]] double medianFps() const { return frames / wall_s[wall_s.size() / 2]; }
};
using Scores = std::map<std::string, MappingScore>;

/// Scores the home that the last of the runs has written.
[[nodiscard]] MappingScore scoreRuns(const BenchRecording& recording, const std::vector<ChildRun>& runs, const std::filesystem::path& home);

}  // namespace oikos::bench
