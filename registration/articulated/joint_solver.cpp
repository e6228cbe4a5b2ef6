// SPDX-License-Identifier: Apache-2.0
// Pellegrini, Schindler & Nardi, "A generalisation of the ICP algorithm for articulated bodies" (BMVC 2008, doi:10.5244/C.22.87) registers
// part after part along the joints and goes over them again. Here every part's pixels come from one rendered picture, so that all
// may also be solved for at once, and pixels are weighted by a mixture (expectation maximisation) instead of trimmed.
#include "registration/articulated/joint_solver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/config_rules.h"
#include "registration/articulated/pixel_terms.h"
#include "registration/motion.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Eigen::Vector3d middleOf(const JointTree& tree) {
  const std::vector<Eigen::Isometry3d> T_model_part = tree.partPoses(std::vector<double>(tree.model().joints.size(), 0.0));
  Eigen::AlignedBox3d box;
  for (std::size_t part = 0; part < T_model_part.size(); ++part) {
    if (tree.model().parts[part].mesh_part) {
      for (const Eigen::Vector3f& vertex : tree.model().parts[part].mesh_part->vertices) {
        box.extend(T_model_part[part] * vertex.cast<double>());
      }
    }
  }
  return box.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center());
}

/// Deviations of x, y, z and of turns about them; x and y are as well known as each other, and so are the two tilts.
geometry::Vector6d sigmasOf(const JointSolverConfig& config) {
  geometry::Vector6d sigmas;
  sigmas << config.base_sigma_m, config.base_sigma_m, config.upright_sigma_m, config.upright_sigma_deg * kDegree,
      config.upright_sigma_deg * kDegree, config.base_sigma_deg * kDegree;
  return sigmas;
}

}  // namespace

geometry::Matrix6d priorCovariance(const JointSolverConfig& config) {
  return sigmasOf(config).cwiseAbs2().asDiagonal();
}

std::vector<std::string> JointSolverConfig::validate() const {
  return base::ConfigRules()
      .greater("base_sigma_m", base_sigma_m, 0.0)
      .greater("base_sigma_deg", base_sigma_deg, 0.0)
      .greater("upright_sigma_m", upright_sigma_m, 0.0)
      .greater("upright_sigma_deg", upright_sigma_deg, 0.0)
      .greater("axis_sigma_m", axis_sigma_m, 0.0)
      .atLeast("axis_sigma_deg", axis_sigma_deg, 0.0)
      .greater("surface_sigma_m", surface_sigma_m, 0.0)
      .atLeast("wide_sigma_m", wide_sigma_m, surface_sigma_m)
      .require(tempering > 0.0 && tempering <= 1.0, "tempering", tempering, "must be > 0 and <= 1")
      .between("depth_distortion", depth_distortion, 0.0, 0.2)
      .greater("most_readings", most_readings, 0.0)
      .atLeast("rounds", rounds, 1)
      .messages();
}

JointSolver::JointSolver(const JointTree& tree, WholeModel& model, const Scan& scan, const PixelMixture& mixture,
                         const JointSolverConfig& config, const Eigen::Isometry3d& T_map_camera, const Eigen::Isometry3d& T_map_prior)
    : tree_(tree),
      model_(model),
      scan_(scan),
      mixture_(mixture),
      config_(config),
      T_map_camera_(T_map_camera),
      T_map_prior_(T_map_prior),
      pivot_model_(middleOf(tree)),
      edges_(scan) {}

/// The model as it is estimated, each joint where it is believed to be.
std::vector<Eigen::Isometry3d> JointSolver::T_map_part(const JointEstimates& estimates) const {
  std::vector<Eigen::Isometry3d> T_map_part = tree_.partPoses(estimates.standing.joint_values);
  for (std::size_t part = 0; part < T_map_part.size(); ++part) {
    T_map_part[part] = estimates.standing.T_map_model * T_map_part[part];
    for (const int mover : tree_.links()[static_cast<std::size_t>(tree_.linkOf(static_cast<int>(part)))].chain) {
      T_map_part[part].pretranslate(estimates.shift_map[static_cast<std::size_t>(mover)]);
    }
  }
  return T_map_part;
}

std::vector<JointAxis> JointSolver::axesOf(const JointEstimates& estimates) const {
  std::vector<JointAxis> axes = tree_.axes(estimates.standing.T_map_model, tree_.partPoses(estimates.standing.joint_values));
  for (std::size_t link = 1; link < axes.size(); ++link) {
    for (const int mover : tree_.links()[link].chain) {
      axes[link].origin_map += estimates.shift_map[static_cast<std::size_t>(mover)];
    }
  }
  return axes;
}

JointEquations JointSolver::look(const JointEstimates& estimates, const Freedom& freedom, double width_m) {
  JointEquations equations(tree_, axesOf(estimates), estimates.standing.T_map_model * pivot_model_, config_.surface_sigma_m);
  model_.place(T_map_part(estimates));
  const render::View view = model_.look(T_map_camera_, scan_.camera);
  const PixelSource source = {tree_, scan_, edges_, mixture_, T_map_camera_, config_.surface_sigma_m, width_m};
  addSurfaceTerms(view, source, equations);
  addOutlineTerms(view, source, equations);
  equations.gather(config_.tempering, config_.most_readings, countingLinks(freedom));
  addPriors(estimates, equations);
  return equations;
}

/// While the base moves, a part speaks only if its joints may give way.
std::vector<char> JointSolver::countingLinks(const Freedom& freedom) const {
  std::vector<char> counts(tree_.links().size(), 1);
  for (std::size_t link = 0; freedom.base && link < counts.size(); ++link) {
    const std::vector<int>& chain = tree_.links()[link].chain;
    const bool gives_way = std::all_of(chain.begin(), chain.end(), [&](int mover) {
      return std::find(freedom.links.begin(), freedom.links.end(), mover) != freedom.links.end();
    });
    counts[link] = gives_way ? 1 : 0;
  }
  return counts;
}

geometry::Vector6d JointSolver::baseOff(const JointEstimates& estimates) const {
  const Eigen::Isometry3d& T_map_model = estimates.standing.T_map_model;
  geometry::Vector6d off;
  off << T_map_model * pivot_model_ - T_map_prior_ * pivot_model_,
      geometry::logSo3(T_map_model.linear() * T_map_prior_.linear().transpose());
  return off;
}

std::vector<double> JointSolver::offPrior(const JointEstimates& estimates) const {
  const double of_base = baseOff(estimates).cwiseQuotient(sigmasOf(config_)).squaredNorm();
  std::vector<double> off(tree_.links().size(), of_base);
  for (std::size_t link = 1; link < off.size(); ++link) {
    for (const int mover : tree_.links()[link].chain) {
      off[link] += (estimates.shift_map[static_cast<std::size_t>(mover)] / config_.axis_sigma_m).squaredNorm();
    }
  }
  return off;
}

/// The base from where it is believed, and each joint from where the model has it.
void JointSolver::addPriors(const JointEstimates& estimates, JointEquations& equations) const {
  const geometry::Vector6d information = sigmasOf(config_).cwiseAbs2().cwiseInverse();
  equations.H.diagonal().head<kBaseSize>() += information;
  equations.g.head<kBaseSize>() += information.cwiseProduct(baseOff(estimates));
  const double of_axis = 1.0 / (config_.axis_sigma_m * config_.axis_sigma_m);
  for (std::size_t link = 1; link < tree_.links().size(); ++link) {
    const int first = firstOf(static_cast<int>(link)) + 1;
    equations.H.diagonal().segment<3>(first).array() += of_axis;
    equations.g.segment<3>(first) += of_axis * estimates.shift_map[link];
  }
}

std::vector<int> JointSolver::freeIndices(const Freedom& freedom) const {
  std::vector<int> free;
  for (int i = 0; freedom.base && i < kBaseSize; ++i) {
    free.push_back(i);
  }
  for (const int link : freedom.links) {
    for (int i = 0; i < kLinkSize; ++i) {
      free.push_back(firstOf(link) + i);
    }
  }
  return free;
}

/// A joint that would go beyond its limit goes there, and the others take that as given.
Eigen::VectorXd JointSolver::stepOf(const JointEquations& equations, const JointEstimates& estimates, const Freedom& freedom) const {
  Eigen::VectorXd step = Eigen::VectorXd::Zero(equations.g.size());
  std::vector<int> free = freeIndices(freedom);
  for (bool is_bounded = true; is_bounded && !free.empty();) {
    const Eigen::VectorXd rest = equations.g + equations.H * step;
    const Eigen::VectorXd solved = Eigen::MatrixXd(equations.H(free, free)).ldlt().solve(-rest(free));
    Eigen::VectorXd next = step;
    next(free) += solved;
    is_bounded = false;
    for (const int link : freedom.links) {
      const int index = firstOf(link);
      const auto place = std::find(free.begin(), free.end(), index);
      const model::ModelJoint& joint = tree_.jointOf(link);
      const double value = estimates.standing.joint_values[static_cast<std::size_t>(tree_.links()[static_cast<std::size_t>(link)].joint)];
      const double bounded = std::clamp(value + next[index], joint.lower, joint.upper) - value;
      if (place != free.end() && std::abs(bounded - next[index]) > 1e-9) {
        step[index] = bounded;
        free.erase(place);
        is_bounded = true;
      }
    }
    if (!is_bounded) {
      step = next;
    }
  }
  return step;
}

void JointSolver::apply(const Eigen::VectorXd& step, JointEstimates& estimates) const {
  Standing& standing = estimates.standing;
  standing.T_map_model = motionAbout(standing.T_map_model * pivot_model_, step.head<kBaseSize>()) * standing.T_map_model;
  for (std::size_t link = 1; link < tree_.links().size(); ++link) {
    const int first = firstOf(static_cast<int>(link));
    const model::ModelJoint& joint = tree_.jointOf(static_cast<int>(link));
    double& value = standing.joint_values[static_cast<std::size_t>(tree_.links()[link].joint)];
    if (step[first] != 0.0) {
      value = std::clamp(value + step[first], joint.lower, joint.upper);
    }
    estimates.shift_map[link] += step.segment<3>(first + 1);
  }
}

int JointSolver::solve(JointEstimates& estimates, const Freedom& freedom) {
  constexpr double kSettled = 3e-4;  // m, and rad
  for (int round = 0; round < config_.rounds; ++round) {
    const double share = config_.rounds > 1 ? static_cast<double>(round) / (config_.rounds - 1) : 1.0;
    const double width_m = config_.wide_sigma_m * std::pow(config_.surface_sigma_m / config_.wide_sigma_m, share);
    const JointEquations equations = look(estimates, freedom, width_m);
    const Eigen::VectorXd step = stepOf(equations, estimates, freedom);
    apply(step, estimates);
    if (share == 1.0 && step.lpNorm<Eigen::Infinity>() < kSettled) {
      return round + 1;
    }
  }
  return config_.rounds;
}

SolverReport JointSolver::report(const JointEstimates& estimates, const Freedom& freedom) {
  const JointEquations equations = look(estimates, freedom, config_.surface_sigma_m);
  const std::vector<int> free = freeIndices(freedom);
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd(equations.H(free, free)).ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  if (freedom.base) {
    const Eigen::MatrixXd gain = covariance.leftCols<kBaseSize>();
    covariance += gain * equations.surfaces() * gain.transpose();
  }
  SolverReport report;
  report.counts = equations.counts;
  report.rms_m = equations.agreeing > 0 ? std::sqrt(equations.squares_m / equations.agreeing) : 0.0;
  report.off_prior = offPrior(estimates);
  report.variances.assign(tree_.links().size(), 0.0);
  report.shared_variances.assign(tree_.links().size(), 0.0);
  for (std::size_t i = 0; i < freedom.links.size(); ++i) {
    const auto link = static_cast<std::size_t>(freedom.links[i]);
    const auto index = static_cast<Eigen::Index>(freedom.base ? kBaseSize : 0) + kLinkSize * static_cast<Eigen::Index>(i);
    const double of_axis_rad = config_.axis_sigma_deg * kDegree / std::sqrt(3.0);
    const bool is_turn = equations.axes()[link].is_turn;
    const double distorted = config_.depth_distortion * equations.distortionGain(freedom.links[i]);
    const double of_axis = is_turn ? of_axis_rad * of_axis_rad : config_.axis_sigma_m * config_.axis_sigma_m;
    report.shared_variances[link] = of_axis + distorted * distorted;
    report.variances[link] = covariance(index, index) + (is_turn ? of_axis_rad * of_axis_rad : 0.0) + distorted * distorted;
  }
  if (freedom.base) {
    const Eigen::Matrix3d R_model_map = estimates.standing.T_map_model.linear().transpose();
    geometry::Matrix6d from_pivot = geometry::Matrix6d::Zero();
    from_pivot.topLeftCorner<3, 3>() = R_model_map;
    from_pivot.topRightCorner<3, 3>() = -R_model_map * geometry::skew(estimates.standing.T_map_model.translation() - equations.pivot_map());
    from_pivot.bottomRightCorner<3, 3>() = R_model_map;
    report.base_covariance = from_pivot * covariance.topLeftCorner<kBaseSize, kBaseSize>() * from_pivot.transpose();
  }
  return report;
}

}  // namespace oikos::registration
