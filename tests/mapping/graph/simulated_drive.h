// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "core/geometry/se3.h"
#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

/// The standard deviations of one measured relative pose.
struct MeasurementNoise {
  double sigma_m = 0.0;
  double sigma_rad = 0.0;

  [[nodiscard]] geometry::Matrix6d information() const;
};

inline constexpr MeasurementNoise kOdometryNoise{0.005, 0.003};
inline constexpr MeasurementNoise kLoopNoise{0.01, 0.005};

/// A camera driven round a square of 3 m twice, ten nodes a side: its true poses, and a graph whose poses are the odometry's,
/// with its drift. Node i of the second lap stands where node i - 40 of the first stood.
class SimulatedDrive {
 public:
  static constexpr int kNodesPerLap = 40;

  explicit SimulatedDrive(unsigned seed, int laps = 2);

  /// A loop as it was measured, with noise; returns the edge's position.
  std::size_t addLoop(int from, int to);
  /// A loop that claims `T_from_to`, which is not so.
  std::size_t addWrongLoop(int from, int to, const Eigen::Isometry3d& T_from_to);
  /// As many wrong loops as asked for, between places at least a metre apart, each with its own error.
  std::vector<std::size_t> addRandomWrongLoops(int count);
  /// From node `first` on another sub-map, in a world of its own; the odometry edge that led there is taken out.
  void breakAt(int first, const Eigen::Isometry3d& T_own_world);

  [[nodiscard]] Eigen::Isometry3d trueMotion(int from, int to) const;
  /// Greatest distance of a node from where it truly was, in metres. The first node is where it truly was.
  [[nodiscard]] double worstError_m() const;
  [[nodiscard]] double worstTurn_rad() const;
  [[nodiscard]] std::vector<char> allBelieved() const { return std::vector<char>(graph.edges.size(), 1); }

  KeyframeGraph graph;
  std::vector<Eigen::Isometry3d> T_world_true;

 private:
  [[nodiscard]] Eigen::Isometry3d noisy(const Eigen::Isometry3d& T, const MeasurementNoise& noise);
  std::size_t addEdge(int from, int to, EdgeKind kind, const Eigen::Isometry3d& T_from_to, const MeasurementNoise& noise);

  std::mt19937 random_;
};

}  // namespace oikos::mapping
