// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/base/progress.h"

namespace oikos::simulate {

struct SimulationJob {
  std::filesystem::path script;  ///< HOME/scenes/NAME.toml
  std::filesystem::path folder;  ///< where the recording is written: there, and empty
  std::uint64_t seed = 0;
  int threads = 1;
  base::ProgressSink progress;
};

struct SimulationSummary {
  int frames = 0;
  int lost_frames = 0;
  double duration_s = 0.0;  ///< of the recording
};

/// Records a drive through the home that the script lies in: a TUM recording with `camera.toml`, `groundtruth.txt`, `odometry.txt`,
/// `prior.txt` and `truth/` (docs/formats.md). The same bytes for a seed, for any number of threads. Throws Error.
SimulationSummary simulate(const SimulationJob& job);

}  // namespace oikos::simulate
