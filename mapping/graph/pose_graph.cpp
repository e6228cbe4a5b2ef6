// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/pose_graph.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "mapping/graph/pose_block.h"
#include "mapping/graph/projection_cost.h"
#include "mapping/graph/relative_pose_cost.h"

namespace oikos::mapping {

namespace {

/// Upper factor U with U^T U = information, scaled and with its eigenvalues held in bounds.
geometry::Matrix6d squareRoot(const geometry::Matrix6d& information, const PoseGraphConfig& config) {
  const geometry::Matrix6d symmetric = 0.5 * config.information_scale * (information + information.transpose());
  const Eigen::SelfAdjointEigenSolver<geometry::Matrix6d> eigen(symmetric);
  const geometry::Vector6d values = eigen.eigenvalues().cwiseMax(1.0).cwiseMin(config.max_information);
  return values.cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
}

/// On known ground two nodes may be far apart: then the wheels' drift counts.
geometry::Matrix6d priorSquareRoot(const Eigen::Isometry3d& T_from_to, const PoseGraphConfig& config) {
  const double sigma_m = std::max(config.odometry_sigma_m, config.odometry_drift * T_from_to.translation().norm());
  const double sigma_rad = std::max(config.odometry_sigma_rad, config.odometry_drift * Eigen::AngleAxisd(T_from_to.linear()).angle());
  geometry::Vector6d inverse_sigma;
  inverse_sigma << Eigen::Vector3d::Constant(1.0 / sigma_m), Eigen::Vector3d::Constant(1.0 / sigma_rad);
  return inverse_sigma.asDiagonal();
}

struct Link {
  int from;
  int to;
  Eigen::Isometry3d T_from_to;
};

std::vector<Link> linksBetweenSubmaps(const KeyframeGraph& graph, const std::vector<char>& believed,
                                      const std::vector<MotionPrior>& priors) {
  std::vector<Link> links;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (believed[e] != 0) {
      links.push_back({graph.edges[e].from, graph.edges[e].to, graph.edges[e].T_from_to});
    }
  }
  for (const MotionPrior& prior : priors) {
    links.push_back({prior.from, prior.to, prior.T_from_to});
  }
  return links;
}

/// Moves all nodes of one sub-map by a rigid motion of its world and gives them another number.
void moveSubmap(KeyframeGraph& graph, int submap, int into, const Eigen::Isometry3d& T_into_submap) {
  for (Node& node : graph.nodes) {
    if (node.submap == submap) {
      node.submap = into;
      node.T_world_camera = T_into_submap * node.T_world_camera;
    }
  }
}

}  // namespace

int joinSubmaps(KeyframeGraph& graph, const std::vector<char>& believed, const std::vector<MotionPrior>& priors) {
  const std::vector<Link> links = linksBetweenSubmaps(graph, believed, priors);
  bool joined = true;
  while (joined) {
    joined = false;
    for (const Link& link : links) {
      const Node& from = graph.nodes[static_cast<std::size_t>(link.from)];
      const Node& to = graph.nodes[static_cast<std::size_t>(link.to)];
      if (from.submap == to.submap) {
        continue;
      }
      const Eigen::Isometry3d T_from_to_world = from.T_world_camera * link.T_from_to * to.T_world_camera.inverse();
      if (from.submap < to.submap) {
        moveSubmap(graph, to.submap, from.submap, T_from_to_world);
      } else {
        moveSubmap(graph, from.submap, to.submap, T_from_to_world.inverse());
      }
      joined = true;
    }
  }
  std::set<int> left;
  for (const Node& node : graph.nodes) {
    left.insert(node.submap);
  }
  return static_cast<int>(left.size());
}

PoseGraphResult optimisePoseGraph(KeyframeGraph& graph, const std::vector<char>& believed, const std::vector<MotionPrior>& priors,
                                  const PoseGraphConfig& config) {
  PoseGraphResult result;
  result.loop_weight.assign(graph.edges.size(), 1.0);
  std::vector<PoseBlock> poses;
  for (const Node& node : graph.nodes) {
    poses.push_back(toPoseBlock(node.T_world_camera));
  }
  RightPerturbedPose manifold;
  ceres::CauchyLoss kernel(config.cauchy_sigmas);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  std::set<int> anchored;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    problem.AddParameterBlock(poses[n].data(), 7, &manifold);
    if (anchored.insert(graph.nodes[n].submap).second) {
      problem.SetParameterBlockConstant(poses[n].data());
    }
  }
  const auto add = [&](int from, int to, const Eigen::Isometry3d& T_from_to, const geometry::Matrix6d& root, ceres::LossFunction* loss) {
    return problem.AddResidualBlock(new RelativePoseCost(T_from_to, root), loss, poses[static_cast<std::size_t>(from)].data(),
                                    poses[static_cast<std::size_t>(to)].data());
  };
  std::map<std::size_t, ceres::ResidualBlockId> loops;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Edge& edge = graph.edges[e];
    if (believed[e] == 0) {
      result.loop_weight[e] = 0.0;
    } else {
      const bool loop = edge.kind == EdgeKind::kLoop;
      const auto id = add(edge.from, edge.to, edge.T_from_to, squareRoot(edge.information, config), loop ? &kernel : nullptr);
      if (loop) {
        loops[e] = id;
      }
    }
  }
  for (const MotionPrior& prior : priors) {
    add(prior.from, prior.to, prior.T_from_to, priorSquareRoot(prior.T_from_to, config), &kernel);
  }
  if (problem.NumResidualBlocks() == 0) {
    return result;
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = config.max_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.usable = summary.IsSolutionUsable();
  result.iterations = static_cast<int>(summary.iterations.size());
  result.initial_cost = summary.initial_cost;
  result.final_cost = summary.final_cost;
  if (!result.usable) {
    return result;
  }
  for (const auto& [e, id] : loops) {
    double cost = 0.0;
    problem.EvaluateResidualBlockAssumingParametersUnchanged(id, false, &cost, nullptr, nullptr);
    const double sq = 2.0 * cost;
    result.loop_weight[e] = 1.0 / (1.0 + sq / (config.cauchy_sigmas * config.cauchy_sigmas));
  }
  for (std::size_t n = 0; n < poses.size(); ++n) {
    graph.nodes[n].T_world_camera = fromPoseBlock(poses[n]);
  }
  return result;
}

}  // namespace oikos::mapping
