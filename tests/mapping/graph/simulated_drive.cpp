// SPDX-License-Identifier: Apache-2.0
#include "tests/mapping/graph/simulated_drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oikos::mapping {

namespace {

/// Looks along the side that it drives, image-up is world z; half-way through the turn at a corner's first node.
Eigen::Isometry3d poseOnSquare(int node) {
  constexpr int kPerSide = SimulatedDrive::kNodesPerLap / 4;
  constexpr double kSide_m = 3.0;
  const int side = (node / kPerSide) % 4;
  const double along_m = kSide_m * (node % kPerSide) / kPerSide;
  const double heading_rad = side * 0.5 * std::numbers::pi;
  const Eigen::Vector2d corners[] = {{0.0, 0.0}, {kSide_m, 0.0}, {kSide_m, kSide_m}, {0.0, kSide_m}};
  const Eigen::Vector2d at = corners[side] + along_m * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad));
  const double look_rad = node % kPerSide == 0 ? heading_rad - 0.25 * std::numbers::pi : heading_rad;
  Eigen::Matrix3d R_body_camera;
  R_body_camera << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(look_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() * R_body_camera;
  T.translation() = Eigen::Vector3d(at.x(), at.y(), 1.0 + 0.05 * std::sin(0.7 * node));
  return T;
}

}  // namespace

geometry::Matrix6d MeasurementNoise::information() const {
  geometry::Vector6d diagonal;
  diagonal << Eigen::Vector3d::Constant(1.0 / (sigma_m * sigma_m)), Eigen::Vector3d::Constant(1.0 / (sigma_rad * sigma_rad));
  return diagonal.asDiagonal();
}

SimulatedDrive::SimulatedDrive(unsigned seed, int laps) : random_(seed) {
  for (int n = 0; n < laps * kNodesPerLap; ++n) {
    T_world_true.push_back(poseOnSquare(n));
    Node node;
    node.frame = 5 * n;
    node.stamp_ns = std::int64_t{n} * 200'000'000;
    node.T_world_camera = T_world_true.back();
    graph.nodes.push_back(node);
    if (n > 0) {
      const auto last = static_cast<std::size_t>(n) - 1;
      const std::size_t edge = addEdge(n - 1, n, EdgeKind::kOdometry, noisy(trueMotion(n - 1, n), kOdometryNoise), kOdometryNoise);
      graph.nodes.back().T_world_camera = graph.nodes[last].T_world_camera * graph.edges[edge].T_from_to;
    }
  }
}

std::size_t SimulatedDrive::addLoop(int from, int to) {
  return addEdge(from, to, EdgeKind::kLoop, noisy(trueMotion(from, to), kLoopNoise), kLoopNoise);
}

std::size_t SimulatedDrive::addWrongLoop(int from, int to, const Eigen::Isometry3d& T_from_to) {
  return addEdge(from, to, EdgeKind::kLoop, T_from_to, kLoopNoise);
}

std::vector<std::size_t> SimulatedDrive::addRandomWrongLoops(int count) {
  std::uniform_int_distribution<int> anyNode(0, static_cast<int>(graph.nodes.size()) - 1);
  std::uniform_real_distribution<double> error(-0.4, 0.4);
  std::vector<std::size_t> edges;
  while (static_cast<int>(edges.size()) < count) {
    const int a = anyNode(random_);
    const int b = anyNode(random_);
    if (a < b && trueMotion(a, b).translation().norm() > 1.0) {
      geometry::Vector6d claimed;  // that the two views are of one place, about
      claimed << error(random_), error(random_), error(random_), error(random_), error(random_), error(random_);
      edges.push_back(addWrongLoop(a, b, geometry::expSe3(claimed)));
    }
  }
  return edges;
}

void SimulatedDrive::breakAt(int first, const Eigen::Isometry3d& T_own_world) {
  std::erase_if(graph.edges, [&](const Edge& e) { return e.kind == EdgeKind::kOdometry && e.to == first; });
  for (std::size_t n = static_cast<std::size_t>(first); n < graph.nodes.size(); ++n) {
    ++graph.nodes[n].submap;
    graph.nodes[n].T_world_camera = T_own_world * graph.nodes[n].T_world_camera;
  }
}

Eigen::Isometry3d SimulatedDrive::trueMotion(int from, int to) const {
  return T_world_true[static_cast<std::size_t>(from)].inverse() * T_world_true[static_cast<std::size_t>(to)];
}

double SimulatedDrive::worstError_m() const {
  double worst = 0.0;
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    worst = std::max(worst, (graph.nodes[n].T_world_camera.translation() - T_world_true[n].translation()).norm());
  }
  return worst;
}

double SimulatedDrive::worstTurn_rad() const {
  double worst = 0.0;
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    worst = std::max(worst, Eigen::AngleAxisd(graph.nodes[n].T_world_camera.linear().transpose() * T_world_true[n].linear()).angle());
  }
  return worst;
}

Eigen::Isometry3d SimulatedDrive::noisy(const Eigen::Isometry3d& T, const MeasurementNoise& noise) {
  std::normal_distribution<double> normal(0.0, 1.0);
  geometry::Vector6d xi;
  for (int i = 0; i < 6; ++i) {
    xi[i] = (i < 3 ? noise.sigma_m : noise.sigma_rad) * normal(random_);
  }
  return T * geometry::expSe3(xi);
}

std::size_t SimulatedDrive::addEdge(int from, int to, EdgeKind kind, const Eigen::Isometry3d& T_from_to, const MeasurementNoise& noise) {
  Edge edge;
  edge.from = from;
  edge.to = to;
  edge.kind = kind;
  edge.T_from_to = T_from_to;
  edge.information = noise.information();
  edge.inliers = 60;
  edge.rms_px = 0.6;
  graph.edges.push_back(edge);
  return graph.edges.size() - 1;
}

}  // namespace oikos::mapping
