// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

struct PoseGraphConfig {
  int max_iterations = 50;
  double information_scale = 0.04;  ///< of the edges' information: registration does not know of its systematic errors
  double max_information = 1e6;     ///< per axis (1/m^2, 1/rad^2): one millimetre, one milliradian
  double cauchy_sigmas = 3.0;       ///< robust kernel of loops
  double odometry_sigma_m = 0.03;   ///< of one step of the recorded odometry between two nodes
  double odometry_sigma_rad = 0.03;
  double odometry_drift = 0.03;  ///< share of the way, and of the turn, from which on a step is worse than that

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_iterations", max_iterations);
    visitor("information_scale", information_scale);
    visitor("max_information", max_information);
    visitor("cauchy_sigmas", cauchy_sigmas);
    visitor("odometry_sigma_m", odometry_sigma_m);
    visitor("odometry_sigma_rad", odometry_sigma_rad);
    visitor("odometry_drift", odometry_drift);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Relative motion from another source (wheel odometry): weak, with a robust kernel.
struct MotionPrior {
  int from = -1;
  int to = -1;
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
};

struct [[nodiscard]] PoseGraphResult {
  bool usable = false;  ///< false: the poses are as they were
  int iterations = 0;
  double initial_cost = 0.0;
  double final_cost = 0.0;
  std::vector<double> loop_weight;  ///< one an edge: what the kernel leaves of it, 0 to 1
};

/// Gives nodes of joined sub-maps one world and one sub-map number (the lowest): along the loops in `believed` from the sub-map
/// with the lowest number on. Returns how many sub-maps are left.
int joinSubmaps(KeyframeGraph& graph, const std::vector<char>& believed, const std::vector<MotionPrior>& priors);

/// Optimises the poses of all nodes over the edges in `believed` and the priors: SE(3), weighted by the registrations' covariances
/// (S43, S51), loops and priors under Cauchy's kernel. The first node of each sub-map is fixed. Residual of an edge:
///   L * log(T_from_to^-1 * T_world_from^-1 * T_world_to), L L^T = information.
PoseGraphResult optimisePoseGraph(KeyframeGraph& graph, const std::vector<char>& believed, const std::vector<MotionPrior>& priors,
                                  const PoseGraphConfig& config);

}  // namespace oikos::mapping
