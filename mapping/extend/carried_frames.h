// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/recording/trajectory.h"
#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

/// A keyframe of the earlier map, before and after the optimisation with the new drive.
struct MovedKeyframe {
  int frame = -1;  ///< position in the trajectory
  Eigen::Isometry3d T_map_before = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_after = Eigen::Isometry3d::Identity();
};

/// Moves every frame along with the keyframes before and after it, in proportion to time; outside them with the nearest. `keyframes` in
/// ascending order of their frames, at least one.
[[nodiscard]] recording::Trajectory carryAlong(const recording::Trajectory& trajectory, const std::vector<MovedKeyframe>& keyframes);

}  // namespace oikos::mapping
