// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/recording/trajectory.h"

namespace oikos::bench {

/// A recording to map, and where its camera was.
struct BenchRecording {
  std::string name;
  std::filesystem::path folder;
  int frames = 0;
  recording::Trajectory truth;  ///< `T_truth_camera` of the colour camera
};

/// The names of what can be mapped: real recordings, and variants of them that are made when they are asked for.
///   kitchen, desk-rpy, household-box  as they are
///   kitchen-5hz                       every 6th frame of kitchen at 320x240
///   kitchen-10-laps                   kitchen ten times, forth and back, so that the motion goes on without a jump
[[nodiscard]] const std::vector<std::string>& benchRecordingNames();

/// The folder of the real recording that this one is, or is made from.
[[nodiscard]] std::filesystem::path sourceFolder(const std::string& name, const std::filesystem::path& data);

/// Opens the recording; a variant is written into `scratch`. Throws base::Error if the source is not as expected.
[[nodiscard]] BenchRecording prepareRecording(const std::string& name, const std::filesystem::path& data,
                                              const std::filesystem::path& scratch);

}  // namespace oikos::bench
