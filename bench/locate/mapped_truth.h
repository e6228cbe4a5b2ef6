// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/recording/trajectory.h"

namespace oikos::bench {

/// The reference poses in the map's frame: moved by the rigid motion that aligns the frames that were mapped, places and orientations;
/// prints how well it does.
/// Throws std::runtime_error if they cannot be aligned.
[[nodiscard]] recording::Trajectory truthInMap(const recording::Trajectory& mapped, const recording::Trajectory& truth);

/// Throws std::runtime_error for a stamp that has no pose.
[[nodiscard]] const Eigen::Isometry3d& poseAt(const recording::Trajectory& poses, std::int64_t stamp_ns);

}  // namespace oikos::bench
