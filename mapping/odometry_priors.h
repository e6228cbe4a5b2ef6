// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/recording/trajectory.h"
#include "mapping/graph/front_end.h"
#include "mapping/graph/pose_graph.h"

namespace oikos::mapping {

/// The recording's `odometry.txt` (T_odom_base) seen from the camera: how it moved between any two stamps.
class OdometryPriors {
 public:
  OdometryPriors() = default;
  /// Without odometry, or without the camera's mount on the base, there are no priors.
  OdometryPriors(std::optional<recording::Trajectory> T_odom_base, std::optional<Eigen::Isometry3d> T_base_camera);

  /// One prior between each node and the next.
  [[nodiscard]] std::vector<MotionPrior> betweenNodes(const KeyframeGraph& graph) const;

  /// Moves the poses of lost frames on from the last frame that was not lost, or from the first if all are; true for those that were.
  [[nodiscard]] std::vector<char> carryLostFrames(const std::vector<TrackedFrame>& frames,
                                                  std::vector<Eigen::Isometry3d>& T_world_frame) const;

 private:
  /// Interpolated; nothing outside the recorded time or in a gap of more than half a second.
  [[nodiscard]] std::optional<Eigen::Isometry3d> findCameraPose(std::int64_t stamp_ns) const;
  recording::Trajectory odometry_;  ///< T_odom_camera
};

}  // namespace oikos::mapping
