// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/graph/keyframe_graph.h"
#include "mapping/graph/keyframe_images.h"
#include "mapping/odometry/landmark_follower.h"

namespace oikos::mapping {

struct CovisibilityConfig {
  int max_partners = 12;       ///< nodes that a node looks for landmarks of, those that should show most first
  int min_expected = 12;       ///< landmarks of a partner that should be in view
  double max_view_deg = 50.0;  ///< between the optical axes
  int max_sightings = 10;      ///< of one landmark
  double gate_px = 4.0;        ///< a patch found farther from where the graph expects it is not the landmark

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_partners", max_partners);
    visitor("min_expected", min_expected);
    visitor("max_view_deg", max_view_deg);
    visitor("max_sightings", max_sightings);
    visitor("gate_px", gate_px);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Looks for each node's view of the landmarks of nodes nearby which tracking did not follow into it, from the optimised poses:
/// the more two keyframes share, the stiffer the bundle. Appends observations to the nodes; returns how many.
int addCovisibleObservations(KeyframeGraph& graph, const camera::PinholeCamera& camera, KeyframeImages& images,
                             const FollowerConfig& follower, const CovisibilityConfig& config, int threads);

/// Of a landmark seen from more nodes than that an even choice is kept: the others say hardly more, and would let the refinement grow with
/// every pass over a known place. Returns how many observations went.
int thinSightings(KeyframeGraph& graph, int max_sightings);

}  // namespace oikos::mapping
