// SPDX-License-Identifier: Apache-2.0
// Host-anchored inverse depth (Civera et al., T-RO 2008), Schur complement over the landmarks by Ceres (Agarwal & Mierle); rolling
// shutter as one read-out time for all images with each image's own velocity known from tracking (Hedborg et al., CVPR 2012).
#include "mapping/graph/bundle_adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/camera/depth_noise.h"
#include "mapping/graph/pose_block.h"
#include "mapping/graph/projection_cost.h"
#include "mapping/graph/relative_pose_cost.h"

namespace oikos::mapping {

namespace {

/// The values that Ceres changes, in memory that does not move.
struct Parameters {
  std::vector<PoseBlock> poses;
  std::vector<double> inverse_depths;
  double readout_s = 0.0;
};

Parameters pack(const KeyframeGraph& graph, double readout_s) {
  Parameters p;
  for (const Node& node : graph.nodes) {
    p.poses.push_back(toPoseBlock(node.T_world_camera));
  }
  for (const Landmark& landmark : graph.landmarks) {
    p.inverse_depths.push_back(landmark.inverse_depth);
  }
  p.readout_s = readout_s;
  return p;
}

void unpack(const Parameters& p, KeyframeGraph& graph) {
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    graph.nodes[i].T_world_camera = fromPoseBlock(p.poses[i]);
  }
  for (std::size_t i = 0; i < graph.landmarks.size(); ++i) {
    graph.landmarks[i].inverse_depth = std::clamp(p.inverse_depths[i], 0.02, 20.0);
  }
}

/// weight * (value - expected)
class PullCost final : public ceres::SizedCostFunction<1, 1> {
 public:
  PullCost(double expected, double weight) : expected_(expected), weight_(weight) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = weight_ * (parameters[0][0] - expected_);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      jacobians[0][0] = weight_;
    }
    return true;
  }

 private:
  double expected_;
  double weight_;
};

class Builder {
 public:
  Builder(const KeyframeGraph& graph, const camera::PinholeCamera& camera, const BundleAdjustmentConfig& config, Parameters& parameters)
      : graph_(graph), camera_(camera), config_(config), parameters_(parameters) {}

  /// Returns the ids of the sightings' residuals.
  std::vector<ceres::ResidualBlockId> build(ceres::Problem& problem, Readout readout) {
    addPoses(problem);
    problem.AddParameterBlock(&parameters_.readout_s, 1);
    if (readout == Readout::kRefined) {
      problem.AddResidualBlock(new PullCost(0.0, 1.0 / config_.readout_sigma_s), nullptr, &parameters_.readout_s);
    } else {
      problem.SetParameterBlockConstant(&parameters_.readout_s);
    }
    addSettled(problem);
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
        const Landmark& landmark = graph_.landmarks[l];
        const double weight = std::sqrt(config_.host_depth_weight) / landmark.sigma;
        problem.AddResidualBlock(new PullCost(landmark.measured_inverse_depth, weight), depth_loss_, &parameters_.inverse_depths[l]);
      }
    }
    return sightings;
  }

  static ceres::Problem::Options problemOptions() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

 private:
  void addPoses(ceres::Problem& problem) {
    std::set<int> anchored;
    for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
      double* block = parameters_.poses[n].data();
      problem.AddParameterBlock(block, 7, &manifold_);
      if (anchored.insert(graph_.nodes[n].submap).second) {
        problem.SetParameterBlockConstant(block);
      }
    }
  }

  void addSettled(ceres::Problem& problem) {
    geometry::Vector6d inverse_sigma;
    inverse_sigma << Eigen::Vector3d::Constant(1.0 / config_.settled_sigma_m), Eigen::Vector3d::Constant(1.0 / config_.settled_sigma_rad);
    for (const Edge& edge : graph_.edges) {
      if (std::max(edge.from, edge.to) < graph_.settled) {
        problem.AddResidualBlock(new RelativePoseCost(edge.T_from_to, inverse_sigma.asDiagonal()), nullptr,
                                 parameters_.poses[static_cast<std::size_t>(edge.from)].data(),
                                 parameters_.poses[static_cast<std::size_t>(edge.to)].data());
      }
    }
  }

  ceres::ResidualBlockId addSighting(ceres::Problem& problem, std::size_t node, const Observation& o) {
    const Landmark& landmark = graph_.landmarks[static_cast<std::size_t>(o.landmark)];
    const auto host = static_cast<std::size_t>(landmark.host);
    Sighting sighting;
    sighting.host_px = landmark.pixel;
    sighting.seen_px = o.pixel.cast<double>();
    sighting.host_velocity = graph_.nodes[host].velocity;
    sighting.seen_velocity = graph_.nodes[node].velocity;
    sighting.inverse_sigma_px = 1.0 / (config_.pixel_sigma_px * (1 << o.level));
    addReading(landmark, node, o, sighting);
    return problem.AddResidualBlock(new SightingCost(sighting, camera_), &sighting_loss_, parameters_.poses[host].data(),
                                    parameters_.poses[node].data(), &parameters_.inverse_depths[static_cast<std::size_t>(o.landmark)],
                                    &parameters_.readout_s);
  }

  /// A reading far from what is expected is of another surface, or none.
  void addReading(const Landmark& landmark, std::size_t node, const Observation& o, Sighting& sighting) const {
    const double depth_m = static_cast<float>(o.depth_m);
    if (!(depth_m > 0.0)) {
      return;
    }
    constexpr double kGateSigmas = 4.0;
    const Eigen::Vector3d p = graph_.nodes[node].T_world_camera.inverse() *
                              (graph_.nodes[static_cast<std::size_t>(landmark.host)].T_world_camera * pointInHost(landmark, camera_));
    const double sigma = camera::inverseDepthSigma(depth_m);
    if (p.z() > 0.05 && std::abs(1.0 / p.z() - 1.0 / depth_m) < kGateSigmas * sigma) {
      sighting.measured_inverse_depth = 1.0 / depth_m;
      sighting.inverse_sigma_inverse_depth = std::sqrt(config_.sighting_depth_weight) / sigma;
    }
  }

  const KeyframeGraph& graph_;
  const camera::PinholeCamera& camera_;
  const BundleAdjustmentConfig& config_;
  Parameters& parameters_;
  RightPerturbedPose manifold_;
  ceres::CauchyLoss sighting_loss_{config_.cauchy_sigmas};
  ceres::CauchyLoss depth_loss_value_{2.0};
  ceres::CauchyLoss* depth_loss_ = &depth_loss_value_;
};

/// Over the sightings that agree; the others are the kernel's business.
double rmsOf(const ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& sightings, double sigma_px) {
  double squares = 0.0;
  int count = 0;
  for (const auto id : sightings) {
    double cost = 0.0;
    std::array<double, 3> r{};
    problem.EvaluateResidualBlockAssumingParametersUnchanged(id, false, &cost, r.data(), nullptr);
    const double sq = r[0] * r[0] + r[1] * r[1];
    if (sq < 9.0) {
      squares += sq;
      ++count;
    }
  }
  return count > 0 ? sigma_px * std::sqrt(squares / count) : 0.0;
}

ceres::Solver::Options solverOptions(const ceres::Problem& problem, Parameters& parameters, const BundleAdjustmentConfig& config) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  options.max_num_iterations = config.max_iterations;
  options.num_threads = 1;  // more threads sum in another order
  options.function_tolerance = config.function_tolerance;
  options.logging_type = ceres::SILENT;
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (double& inverse_depth : parameters.inverse_depths) {
    if (problem.HasParameterBlock(&inverse_depth)) {
      ordering->AddElementToGroup(&inverse_depth, 0);
    }
  }
  for (PoseBlock& pose : parameters.poses) {
    ordering->AddElementToGroup(pose.data(), 1);
  }
  ordering->AddElementToGroup(&parameters.readout_s, 1);
  options.linear_solver_ordering = ordering;
  return options;
}

}  // namespace

BundleAdjustmentResult adjustBundle(KeyframeGraph& graph, const camera::PinholeCamera& camera, double readout_start_s, Readout readout,
                                    const BundleAdjustmentConfig& config) {
  BundleAdjustmentResult result;
  result.readout_s = readout_start_s;
  Parameters parameters = pack(graph, readout_start_s);
  Builder builder(graph, camera, config, parameters);
  ceres::Problem problem(Builder::problemOptions());
  const std::vector<ceres::ResidualBlockId> sightings = builder.build(problem, readout);
  result.sightings = static_cast<int>(sightings.size());
  if (sightings.empty()) {
    return result;
  }
  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(problem, parameters, config), &problem, &summary);
  result.usable = summary.IsSolutionUsable();
  result.iterations = static_cast<int>(summary.iterations.size());
  result.initial_cost = summary.initial_cost;
  result.final_cost = summary.final_cost;
  if (result.usable) {
    unpack(parameters, graph);
    result.readout_s = parameters.readout_s;
    result.rms_px = rmsOf(problem, sightings, config.pixel_sigma_px);
  }
  return result;
}

}  // namespace oikos::mapping
