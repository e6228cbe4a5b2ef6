// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mapping/graph/keyframe_graph.h"
#include "mapping/graph/pose_graph.h"

namespace oikos::mapping {

struct LoopConsistencyConfig {
  double drift_m_per_edge = 0.01;  ///< how far the odometry may stray on one edge, standard deviation
  double drift_rad_per_edge = 0.006;
  double loop_sigma_m = 0.02;  ///< of a loop's own measurement
  double loop_sigma_rad = 0.01;
  double gate_sigmas = 4.0;       ///< a cycle that fails to close by more is inconsistent
  double look_alike_sigmas = 12;  ///< a loop that tracking would have to stray so far for leads to a place that only looks the same

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("drift_m_per_edge", drift_m_per_edge);
    visitor("drift_rad_per_edge", drift_rad_per_edge);
    visitor("loop_sigma_m", loop_sigma_m);
    visitor("loop_sigma_rad", loop_sigma_rad);
    visitor("gate_sigmas", gate_sigmas);
    visitor("look_alike_sigmas", look_alike_sigmas);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Whether tracking may have strayed as far as this loop says; `wheels` join sub-maps. True between two of which nothing is known.
[[nodiscard]] bool driftAllows(const KeyframeGraph& graph, const Edge& loop, const std::vector<MotionPrior>& wheels,
                               const LoopConsistencyConfig& config);

/// Whether loops seen in at least `views` nodes, this one among them, say the same of how its two sub-maps lie to each other: what a drive
/// has to show before it goes on in the world of a map that is extended.
[[nodiscard]] bool isConfirmed(const KeyframeGraph& graph, const Edge& loop, int views, const LoopConsistencyConfig& config);

/// Which loop edges to believe: the largest set found of which every two close a cycle with the odometry between them (Mangelson
/// et al., "Pairwise Consistent Measurement Set Maximization", ICRA 2018), by a greedy search from every edge. Loops to places that
/// only look the same agree with one another too: what tracking contradicts, or `wheels` between two sub-maps, has no say. Loops
/// between the same two sub-maps are judged among themselves. A lone loop is believed only if the odometry itself agrees with it,
/// or if it is all that joins two sub-maps and has `min_lone_inliers` inliers, but never if it joins one to a map that is extended. One
/// entry an edge of the graph; odometry: true.
[[nodiscard]] std::vector<char> consistentEdges(const KeyframeGraph& graph, const std::vector<MotionPrior>& wheels,
                                                const LoopConsistencyConfig& config, int min_lone_inliers = 40);

}  // namespace oikos::mapping
