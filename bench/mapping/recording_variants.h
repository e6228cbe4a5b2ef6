// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/recording/trajectory.h"

namespace oikos::bench {

/// Writes every `step`-th frame of a 7-Scenes folder at half its size, with its number, so that its stamp stays; and the calibration of the
/// smaller images.
void writeHalfSize(const std::filesystem::path& source, int step, const std::filesystem::path& folder);

/// Links the frames of a 7-Scenes folder forth, back, forth, … and numbers them through. Returns the poses that belong to them.
[[nodiscard]] recording::Trajectory linkLaps(const std::filesystem::path& source, int laps, const recording::Trajectory& truth,
                                             const std::filesystem::path& folder);

/// Links the frames of a 7-Scenes folder from `first` to before `end`, each with its number, so that its stamp stays.
void linkFrames(const std::filesystem::path& source, int first, int end, const std::filesystem::path& folder);

}  // namespace oikos::bench
