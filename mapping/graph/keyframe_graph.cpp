// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/keyframe_graph.h"

#include <algorithm>

namespace oikos::mapping {

bool isInView(const KeyframeGraph& graph, int landmark, const Eigen::Isometry3d& T_world_camera, const camera::PinholeCamera& camera) {
  constexpr double kNear_m = 0.1;
  constexpr double kBorder_px = 8.0;
  const Landmark& l = graph.landmarks[static_cast<std::size_t>(landmark)];
  const Eigen::Isometry3d& T_world_host = graph.nodes[static_cast<std::size_t>(l.host)].T_world_camera;
  const Eigen::Vector3d p = T_world_camera.inverse() * (T_world_host * pointInHost(l, camera));
  return p.z() > kNear_m && camera.contains(camera.project(p), kBorder_px);
}

int countInView(const KeyframeGraph& graph, int node, const Eigen::Isometry3d& T_world_camera, const camera::PinholeCamera& camera) {
  const std::vector<int>& hosted = graph.nodes[static_cast<std::size_t>(node)].hosted;
  return static_cast<int>(std::count_if(hosted.begin(), hosted.end(), [&](int id) { return isInView(graph, id, T_world_camera, camera); }));
}

}  // namespace oikos::mapping
