// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

struct SimulatedBundleConfig {
  unsigned seed = 1;
  int nodes = 10;
  int landmarks_per_node = 40;
  double pixel_sigma_px = 0.3;
  double depth_sigmas = 1.0;    ///< noise of depth readings, in deviations of the sensor's model
  double readout_s = 0.0;       ///< of the camera that took the images
  double start_shift_m = 0.02;  ///< deviation of the poses that the adjustment starts from
  double start_turn_rad = 0.01;
};

/// Nodes on an arc that look at its middle, each host to landmarks all about at 1.5 to 3 m, seen by all others that have
/// them in view. Every node moves at 0.4 m/s and turns at 0.8 rad/s while its image is read out.
struct SimulatedBundle {
  explicit SimulatedBundle(const SimulatedBundleConfig& config);

  /// Greatest distance and turn of a node from the truth.
  [[nodiscard]] double worstError_m() const;
  [[nodiscard]] double worstTurn_rad() const;
  /// Of the depth along the landmark's ray, over all landmarks.
  [[nodiscard]] double rmsDepthError_m() const;

  camera::PinholeCamera camera{640, 480, 525.0, 525.0, 319.5, 239.5};
  KeyframeGraph graph;
  std::vector<Eigen::Isometry3d> T_world_true;
  std::vector<double> true_inverse_depth;

 private:
  void placeNodes();
  void hostLandmarks();
  void observe();
  void disturbPoses();
  [[nodiscard]] Eigen::Isometry3d poseAtRow(std::size_t node, double row_px) const;
  double normal(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }

  SimulatedBundleConfig config_;
  std::mt19937 random_;
};

}  // namespace oikos::mapping
