// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/geometry/se3.h"
#include "mapping/odometry/landmark.h"

namespace oikos::mapping {

/// A frame whose pose the optimisation estimates: a keyframe, or a bridge, a frame that ties two stretches of the drive together.
struct Node {
  int frame = -1;  ///< position in the recording
  std::int64_t stamp_ns = 0;
  int submap = 0;        ///< stretches that no measurement joins have different numbers
  bool keyframe = true;  ///< false: a bridge; it hosts no landmarks and is not fused into the map
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< body twist (m/s, rad/s) while the image was read out
  std::vector<int> hosted;                                   ///< landmarks
  std::vector<Observation> observations;                     ///< of other nodes' landmarks
};

enum class EdgeKind { kOdometry, kLoop };

struct Edge {
  int from = -1;
  int to = -1;
  EdgeKind kind = EdgeKind::kOdometry;
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
  geometry::Matrix6d information = geometry::Matrix6d::Identity();  ///< of the right perturbation of T_from_to (1/m^2, 1/rad^2)
  int inliers = 0;
  double rms_px = 0.0;
  std::vector<Observation> observations;  ///< of a loop: old landmarks seen again in `to`; the node gets them once the loop is accepted
};

/// What the front end hands to the optimisation. Node ids are positions in `nodes`, in the order of the drive.
struct KeyframeGraph {
  std::vector<Node> nodes;
  std::vector<Landmark> landmarks;
  std::vector<Edge> edges;
  int settled = 0;  ///< so many nodes at the front are keyframes of a map that is extended: an earlier run has put them in their places
};

/// Whether a camera there has the landmark in its image, whatever stands before it.
[[nodiscard]] bool isInView(const KeyframeGraph& graph, int landmark, const Eigen::Isometry3d& T_world_camera,
                            const camera::PinholeCamera& camera);
/// How many of those that the node hosts.
[[nodiscard]] int countInView(const KeyframeGraph& graph, int node, const Eigen::Isometry3d& T_world_camera,
                              const camera::PinholeCamera& camera);

}  // namespace oikos::mapping
