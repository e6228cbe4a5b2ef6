// SPDX-License-Identifier: Apache-2.0
// What the wheels say about the drive as a whole.
#pragma once

#include <vector>

#include "mapping/graph/front_end.h"
#include "mapping/graph/pose_graph.h"
#include "mapping/odometry/wheel_odometry.h"

namespace oikos::mapping {

/// One prior between each node and the next.
[[nodiscard]] std::vector<MotionPrior> motionPriors(const WheelOdometry& odometry, const KeyframeGraph& graph);

/// Moves the poses of lost frames on from the last frame that was not lost, or from the first if all are; true for those that were.
[[nodiscard]] std::vector<char> carryLostFrames(const WheelOdometry& odometry, const std::vector<TrackedFrame>& frames,
                                                std::vector<Eigen::Isometry3d>& T_world_frame);

}  // namespace oikos::mapping
