// SPDX-License-Identifier: Apache-2.0
// Host-anchored inverse depth (Civera et al., T-RO 2008), Schur complement over the landmarks by Ceres (Agarwal & Mierle); rolling
// shutter as one read-out time for all images with each image's own velocity known from tracking (Hedborg et al., CVPR 2012).
#include "mapping/graph/bundle_adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "mapping/graph/projection_cost.h"
#include "mapping/odometry/depth_noise.h"

namespace oikos::mapping {

namespace {

/// The values that Ceres changes, in memory that does not move.
struct Parameters {
  std::vector<std::array<double, 7>> poses;
  std::vector<double> inverse_depths;
  std::array<double, 4> lens;
  double readout_s = 0.0;
  double depth_scale = 1.0;
};

std::array<double, 7> toBlock(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  return {T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()};
}

Eigen::Isometry3d fromBlock(const std::array<double, 7>& block) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(block[6], block[3], block[4], block[5]).normalized().toRotationMatrix();
  T.translation() = Eigen::Vector3d(block[0], block[1], block[2]);
  return T;
}

Parameters pack(const KeyframeGraph& graph, const SharedCalibration& start) {
  Parameters p;
  for (const Node& node : graph.nodes) {
    p.poses.push_back(toBlock(node.T_world_camera));
  }
  for (const Landmark& landmark : graph.landmarks) {
    p.inverse_depths.push_back(landmark.inverse_depth);
  }
  p.lens = {start.camera.fx, start.camera.fy, start.camera.cx, start.camera.cy};
  p.readout_s = start.readout_s;
  p.depth_scale = start.depth_scale;
  return p;
}

void unpack(const Parameters& p, KeyframeGraph& graph, SharedCalibration& calibration) {
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    graph.nodes[i].T_world_camera = fromBlock(p.poses[i]);
  }
  for (std::size_t i = 0; i < graph.landmarks.size(); ++i) {
    graph.landmarks[i].inverse_depth = std::clamp(p.inverse_depths[i], 0.02, 20.0);
  }
  calibration.camera.fx = p.lens[0];
  calibration.camera.fy = p.lens[1];
  calibration.camera.cx = p.lens[2];
  calibration.camera.cy = p.lens[3];
  calibration.readout_s = p.readout_s;
  calibration.depth_scale = p.depth_scale;
}

class Builder {
 public:
  Builder(const KeyframeGraph& graph, const SharedCalibration& start, const BundleAdjustmentConfig& config, Parameters& parameters)
      : graph_(graph), start_(start), config_(config), parameters_(parameters) {}

  /// Adds all residuals; returns the ids of those that are sightings' projections.
  std::vector<ceres::ResidualBlockId> build(ceres::Problem& problem) {
    addPoses(problem);
    addShared(problem);
    std::vector<ceres::ResidualBlockId> sightings;
    std::vector<char> used(graph_.landmarks.size(), 0);
    for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
      for (const Observation& o : graph_.nodes[n].observations) {
        if (graph_.landmarks[static_cast<std::size_t>(o.landmark)].host != static_cast<int>(n)) {
          sightings.push_back(addSighting(problem, n, o));
          used[static_cast<std::size_t>(o.landmark)] = 1;
        }
      }
    }
    for (std::size_t l = 0; l < used.size(); ++l) {
      if (used[l] != 0) {
        addHostDepth(problem, l);
      }
    }
    return sightings;
  }

 private:
  void addPoses(ceres::Problem& problem) {
    std::set<int> anchored;
    for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
      double* block = parameters_.poses[n].data();
      problem.AddParameterBlock(block, 7, new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>());
      if (anchored.insert(graph_.nodes[n].submap).second) {
        problem.SetParameterBlockConstant(block);
      }
    }
  }

  void addShared(ceres::Problem& problem) {
    problem.AddParameterBlock(parameters_.lens.data(), 4);
    problem.AddParameterBlock(&parameters_.readout_s, 1);
    problem.AddParameterBlock(&parameters_.depth_scale, 1);
    if (config_.refine_intrinsics) {
      const auto& c = start_.camera;
      const Eigen::Vector4d sigma(config_.focal_prior * c.fx, config_.focal_prior * c.fy, config_.centre_prior_px, config_.centre_prior_px);
      addPrior<4>(problem, parameters_.lens.data(), {c.fx, c.fy, c.cx, c.cy}, sigma);
    } else {
      problem.SetParameterBlockConstant(parameters_.lens.data());
    }
    addOptional(problem, &parameters_.readout_s, config_.refine_readout, 0.0, config_.readout_prior_s);
    addOptional(problem, &parameters_.depth_scale, config_.refine_depth_scale, 1.0, config_.depth_scale_prior);
  }

  void addOptional(ceres::Problem& problem, double* block, bool refine, double expected, double sigma) {
    if (refine) {
      addPrior<1>(problem, block, Eigen::Matrix<double, 1, 1>(expected), Eigen::Matrix<double, 1, 1>(sigma));
    } else {
      problem.SetParameterBlockConstant(block);
    }
  }

  template <int N>
  void addPrior(ceres::Problem& problem, double* block, const Eigen::Matrix<double, N, 1>& expected, const Eigen::Matrix<double, N, 1>& sigma) {
    auto* cost = new PriorCost<N>{expected, sigma.cwiseInverse()};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PriorCost<N>, N, N>(cost), nullptr, block);
  }

  ceres::ResidualBlockId addSighting(ceres::Problem& problem, std::size_t node, const Observation& o) {
    const Landmark& landmark = graph_.landmarks[static_cast<std::size_t>(o.landmark)];
    const auto host = static_cast<std::size_t>(landmark.host);
    double* host_pose = parameters_.poses[host].data();
    double* seen_pose = parameters_.poses[node].data();
    double* inverse_depth = &parameters_.inverse_depths[static_cast<std::size_t>(o.landmark)];
    auto* cost = new ProjectionCost{landmark.pixel,
                                    o.pixel.cast<double>(),
                                    graph_.nodes[host].velocity,
                                    graph_.nodes[node].velocity,
                                    static_cast<double>(start_.camera.height),
                                    1.0 / (config_.pixel_sigma_px * (1 << o.level))};
    const auto id = problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ProjectionCost, 2, 7, 7, 1, 4, 1>(cost),
                                             new ceres::CauchyLoss(config_.cauchy_sigmas), host_pose, seen_pose, inverse_depth,
                                             parameters_.lens.data(), &parameters_.readout_s);
    if (o.depth_m > 0.0F && config_.sighting_depth_weight > 0.0) {
      const double depth_m = static_cast<double>(o.depth_m);
      auto* depth = new SightingDepthCost{landmark.pixel, 1.0 / depth_m, std::sqrt(config_.sighting_depth_weight) / inverseDepthSigma(depth_m)};
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<SightingDepthCost, 1, 7, 7, 1, 4, 1>(depth), new ceres::CauchyLoss(1.5),
                               host_pose, seen_pose, inverse_depth, parameters_.lens.data(), &parameters_.depth_scale);
    }
    return id;
  }

  void addHostDepth(ceres::Problem& problem, std::size_t landmark) {
    const Landmark& l = graph_.landmarks[landmark];
    auto* cost = new HostDepthCost{l.measured_inverse_depth, std::sqrt(config_.host_depth_weight) / l.sigma};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<HostDepthCost, 1, 1, 1>(cost), new ceres::CauchyLoss(2.0),
                             &parameters_.inverse_depths[landmark], &parameters_.depth_scale);
  }

  const KeyframeGraph& graph_;
  const SharedCalibration& start_;
  const BundleAdjustmentConfig& config_;
  Parameters& parameters_;
};

/// Over the sightings that agree; the others are the kernel's business.
double rmsOf(ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& sightings, double sigma_px) {
  double squares = 0.0;
  int count = 0;
  for (const auto id : sightings) {
    double cost = 0.0;
    std::array<double, 2> r{};
    problem.EvaluateResidualBlockAssumingParametersUnchanged(id, false, &cost, r.data(), nullptr);
    const double sq = r[0] * r[0] + r[1] * r[1];
    if (sq < 9.0) {
      squares += sq;
      ++count;
    }
  }
  return count > 0 ? sigma_px * std::sqrt(squares / count) : 0.0;
}

}  // namespace

BundleAdjustmentResult adjustBundle(KeyframeGraph& graph, const SharedCalibration& start, const BundleAdjustmentConfig& config) {
  BundleAdjustmentResult result;
  result.calibration = start;
  Parameters parameters = pack(graph, start);
  ceres::Problem problem;
  const std::vector<ceres::ResidualBlockId> sightings = Builder(graph, start, config, parameters).build(problem);
  result.sightings = static_cast<int>(sightings.size());
  if (sightings.empty()) {
    return result;
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  options.max_num_iterations = config.max_iterations;
  options.num_threads = 1;  // more threads sum in another order
  options.function_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t l = 0; l < parameters.inverse_depths.size(); ++l) {
    if (problem.HasParameterBlock(&parameters.inverse_depths[l])) {
      ordering->AddElementToGroup(&parameters.inverse_depths[l], 0);
    }
  }
  for (auto& pose : parameters.poses) {
    ordering->AddElementToGroup(pose.data(), 1);
  }
  ordering->AddElementToGroup(parameters.lens.data(), 1);
  ordering->AddElementToGroup(&parameters.readout_s, 1);
  ordering->AddElementToGroup(&parameters.depth_scale, 1);
  options.linear_solver_ordering = ordering;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.usable = summary.IsSolutionUsable();
  result.iterations = static_cast<int>(summary.iterations.size());
  result.initial_cost = summary.initial_cost;
  result.final_cost = summary.final_cost;
  if (result.usable) {
    unpack(parameters, graph, result.calibration);
    result.rms_px = rmsOf(problem, sightings, config.pixel_sigma_px);
  }
  return result;
}

}  // namespace oikos::mapping
