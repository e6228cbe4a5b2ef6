// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mapping/graph/front_end.h"

namespace oikos::mapping {

struct RollingShutterCamera {
  camera::PinholeCamera pinhole;
  double readout_s = 0.0;  ///< from the first to the last image row

  /// Exposure of an image row after the stamp.
  [[nodiscard]] double rowTime_s(double row_px) const { return (row_px / pinhole.height - 0.5) * readout_s; }
};

/// A frame's pose as it hangs on its reference node now.
[[nodiscard]] std::vector<Eigen::Isometry3d> posesFromReferences(const KeyframeGraph& graph, const std::vector<TrackedFrame>& frames);

/// Body twist (m/s, rad/s) of each frame, from the frames before and after it; zero at a gap of more than `max_gap_s`.
[[nodiscard]] std::vector<geometry::Vector6d> velocitiesOf(const std::vector<TrackedFrame>& frames,
                                                           const std::vector<Eigen::Isometry3d>& T_world_frame, double max_gap_s = 0.15);

/// Gives each node whose frame is among these its velocity.
void setNodeVelocities(KeyframeGraph& graph, const std::vector<TrackedFrame>& frames, const std::vector<geometry::Vector6d>& velocities);

/// The pose of every frame from its own sightings of the refined landmarks; where these are too few, from its reference node.
[[nodiscard]] std::vector<Eigen::Isometry3d> solveFramePoses(const KeyframeGraph& graph, const std::vector<TrackedFrame>& frames,
                                                             const RollingShutterCamera& camera,
                                                             const std::vector<geometry::Vector6d>& velocities, double pixel_sigma_px,
                                                             int threads);

}  // namespace oikos::mapping
