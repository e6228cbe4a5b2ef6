// SPDX-License-Identifier: Apache-2.0
#include "tests/mapping/graph/simulated_bundle.h"

#include <algorithm>
#include <cmath>

#include "core/camera/depth_noise.h"
#include "core/geometry/se3.h"
#include "tests/support/analytic_room.h"

namespace oikos::mapping {

SimulatedBundle::SimulatedBundle(const SimulatedBundleConfig& config) : config_(config), random_(config.seed) {
  placeNodes();
  hostLandmarks();
  observe();
  disturbPoses();
}

void SimulatedBundle::placeNodes() {
  for (int n = 0; n < config_.nodes; ++n) {
    const double angle_rad = 0.1 * n;
    const Eigen::Vector3d eye(2.2 * std::cos(angle_rad), 2.2 * std::sin(angle_rad), 1.2 + 0.1 * (n % 3));
    Node node;
    node.frame = 3 * n;
    node.stamp_ns = std::int64_t{n} * 100'000'000;
    node.T_world_camera = test::lookAt(eye, {0.0, 0.0, 0.8});
    const Eigen::Vector3d way = Eigen::Vector3d(normal(1.0), normal(1.0), normal(1.0)).normalized();
    const Eigen::Vector3d axis = Eigen::Vector3d(normal(1.0), normal(1.0), normal(1.0)).normalized();
    node.velocity << 0.4 * way, 0.8 * axis;
    T_world_true.push_back(node.T_world_camera);
    graph.nodes.push_back(node);
  }
}

void SimulatedBundle::hostLandmarks() {
  std::uniform_real_distribution<double> u(20.0, 620.0);
  std::uniform_real_distribution<double> v(20.0, 460.0);
  std::uniform_real_distribution<double> depth(1.5, 3.0);
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    for (int l = 0; l < config_.landmarks_per_node; ++l) {
      const double depth_m = depth(random_);
      Landmark landmark;
      landmark.host = static_cast<int>(n);
      landmark.pixel = {u(random_), v(random_)};
      landmark.sigma = camera::inverseDepthSigma(depth_m);
      landmark.measured_inverse_depth = 1.0 / depth_m + normal(config_.depth_sigmas * landmark.sigma);
      landmark.inverse_depth = landmark.measured_inverse_depth;
      true_inverse_depth.push_back(1.0 / depth_m);
      graph.nodes[n].hosted.push_back(static_cast<int>(graph.landmarks.size()));
      graph.landmarks.push_back(landmark);
    }
  }
}

Eigen::Isometry3d SimulatedBundle::poseAtRow(std::size_t node, double row_px) const {
  const double time_s = (row_px / camera.height - 0.5) * config_.readout_s;
  return T_world_true[node] * geometry::expSe3(time_s * graph.nodes[node].velocity);
}

void SimulatedBundle::observe() {
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    for (std::size_t l = 0; l < graph.landmarks.size(); ++l) {
      const Landmark& landmark = graph.landmarks[l];
      const auto host = static_cast<std::size_t>(landmark.host);
      if (host == n) {
        continue;
      }
      const Eigen::Vector3d point_world =
          poseAtRow(host, landmark.pixel.y()) * Eigen::Vector3d(camera.ray(landmark.pixel.x(), landmark.pixel.y()) / true_inverse_depth[l]);
      double row_px = 0.5 * camera.height;
      Eigen::Vector3d p;
      for (int i = 0; i < 6; ++i) {  // the row that sees the point is exposed when the camera is where that row sees it
        p = poseAtRow(n, row_px).inverse() * point_world;
        row_px = p.z() > 0.1 ? camera.project(p).y() : row_px;
      }
      if (p.z() > 0.1 && camera.contains(camera.project(p), 5.0)) {
        const Eigen::Vector2d pixel = camera.project(p) + Eigen::Vector2d(normal(config_.pixel_sigma_px), normal(config_.pixel_sigma_px));
        const double reading_m = p.z() + normal(config_.depth_sigmas * camera::depthSigma_m(p.z()));
        graph.nodes[n].observations.push_back({static_cast<int>(l), pixel.cast<float>(), Eigen::half(static_cast<float>(reading_m)), 0});
      }
    }
  }
}

void SimulatedBundle::disturbPoses() {
  for (std::size_t n = 1; n < graph.nodes.size(); ++n) {
    geometry::Vector6d xi;
    for (int i = 0; i < 6; ++i) {
      xi[i] = normal(i < 3 ? config_.start_shift_m : config_.start_turn_rad);
    }
    graph.nodes[n].T_world_camera = T_world_true[n] * geometry::expSe3(xi);
  }
}

double SimulatedBundle::worstError_m() const {
  double worst = 0.0;
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    worst = std::max(worst, (graph.nodes[n].T_world_camera.translation() - T_world_true[n].translation()).norm());
  }
  return worst;
}

double SimulatedBundle::worstTurn_rad() const {
  double worst = 0.0;
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    worst = std::max(worst, Eigen::AngleAxisd(graph.nodes[n].T_world_camera.linear().transpose() * T_world_true[n].linear()).angle());
  }
  return worst;
}

double SimulatedBundle::rmsDepthError_m() const {
  double squares = 0.0;
  for (std::size_t l = 0; l < graph.landmarks.size(); ++l) {
    const double error_m = 1.0 / graph.landmarks[l].inverse_depth - 1.0 / true_inverse_depth[l];
    squares += error_m * error_m;
  }
  return std::sqrt(squares / static_cast<double>(graph.landmarks.size()));
}

}  // namespace oikos::mapping
