// SPDX-License-Identifier: Apache-2.0
// Which landmarks to look for about a node.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

/// Nodes up to `rings` odometry edges away, in order of their number: their worlds agree, whatever has drifted elsewhere.
[[nodiscard]] std::vector<int> neighbourhood(const KeyframeGraph& graph, int node, int rings);

/// Where the camera is that looks for landmarks.
struct CameraView {
  const camera::PinholeCamera& camera;
  const Eigen::Isometry3d& T_world_camera;
};

/// What the `most_hosts` of these nodes host that share most with a camera there: however often a place is seen again, looking for its
/// landmarks takes no longer.
[[nodiscard]] std::vector<int> localMap(const KeyframeGraph& graph, const std::vector<int>& nodes, const CameraView& view, int most_hosts);

/// How many of the landmarks are in view and not among the active ones.
[[nodiscard]] int countUnknown(const KeyframeGraph& graph, const std::vector<int>& active, const std::vector<int>& landmarks,
                               const CameraView& view);

/// The node that hosts most of the landmarks observed, of which there must be some.
[[nodiscard]] int mainHost(const KeyframeGraph& graph, const std::vector<Observation>& observations);

}  // namespace oikos::mapping
