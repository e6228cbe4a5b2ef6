// SPDX-License-Identifier: Apache-2.0
// Pellegrini, Schindler & Nardi, "A generalisation of the ICP algorithm for articulated bodies" (BMVC 2008, doi:10.5244/C.22.87) registers
// part after part along the joints and goes over them again. Here every part's pixels come from one rendered picture, so that all
// may also be solved for at once, and pixels are weighted by a mixture (expectation maximisation) instead of trimmed.
#include "registration/articulated/joint_solver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/base/config_rules.h"
#include "registration/motion.h"
#include "registration/pairs.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMinIncidenceCos = 0.17;  // readings at a more grazing angle are hardly any
constexpr double kOfRim = 0.05;            // of a reading's weight
constexpr int kBaseSize = 6;
constexpr int kLinkSize = 4;  // its joint's value, and the three coordinates of the joint's place

int firstOf(int link) {
  return kBaseSize + kLinkSize * (link - 1);
}

/// The whole model's pixels speak about all that moves them.
struct LinkSums {
  std::vector<int> indices;  ///< into the whole
  Eigen::MatrixXd H;         ///< lower triangle
  Eigen::VectorXd g;
  Eigen::VectorXd J;
  double readings = 0.0;  ///< weighted with how likely they are of the link
};

/// A sensor's matching window mixes a narrow rim with what lies around it.
bool isInside(const render::View& view, int u, int v) {
  constexpr float kSameFace = 0.9F;
  const int part = view.part.at<int>(v, u);
  const auto& normal = view.normal_camera.at<cv::Vec3f>(v, u);
  const auto continues = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < view.part.cols && y < view.part.rows && view.part.at<int>(y, x) == part &&
           view.normal_camera.at<cv::Vec3f>(y, x).dot(normal) > kSameFace;
  };
  return continues(u - 1, v) && continues(u + 1, v) && continues(u, v - 1) && continues(u, v + 1);
}

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
      .greater("most_readings", most_readings, 0.0)
      .atLeast("rounds", rounds, 1)
      .messages();
}

/// Residual of a pixel, with n the model's normal, p its point, s the reading, and p moved by the columns v of what is free:
///   r(step) = n · (s - p) - n · v * step
struct JointSolver::Equations {
  Equations(const JointTree& tree, const Standing& standing, const Eigen::Vector3d& pivot) : pivot_map(pivot) {
    const auto size = static_cast<Eigen::Index>(kBaseSize + kLinkSize * (tree.links().size() - 1));
    H = Eigen::MatrixXd::Zero(size, size);
    g = Eigen::VectorXd::Zero(size);
    axes = tree.axes(standing.T_map_model, tree.partPoses(standing.joint_values));
    counts.resize(tree.links().size());
    for (const Link& link : tree.links()) {
      LinkSums sum;
      for (int i = 0; i < kBaseSize; ++i) {
        sum.indices.push_back(i);
      }
      for (const int mover : link.chain) {
        for (int i = 0; i < kLinkSize; ++i) {
          sum.indices.push_back(firstOf(mover) + i);
        }
      }
      const auto local = static_cast<Eigen::Index>(sum.indices.size());
      sum.H = Eigen::MatrixXd::Zero(local, local);
      sum.g = Eigen::VectorXd::Zero(local);
      sum.J = Eigen::VectorXd::Zero(local);
      links.push_back(std::move(sum));
    }
  }

  void add(const Link& link, LinkSums& sum, const Eigen::Vector3d& model_map, const Eigen::Vector3d& normal_map, double residual_m,
           double weight) const {
    sum.J.head<3>() = -normal_map;
    sum.J.segment<3>(3) = -(model_map - pivot_map).cross(normal_map);
    Eigen::Index i = kBaseSize;
    for (const int mover : link.chain) {
      sum.J[i] = -normal_map.dot(axes[static_cast<std::size_t>(mover)].velocityOf(model_map));
      sum.J.segment<3>(i + 1) = -normal_map;
      i += kLinkSize;
    }
    sum.H.selfadjointView<Eigen::Lower>().rankUpdate(sum.J, weight);
    sum.g += weight * residual_m * sum.J;
  }

  /// Takes a link's readings for so many at most: neighbours repeat each other, and so do the errors of model and sensor.
  void gather(double tempering, double most_readings, const std::vector<char>& counts_in) {
    for (std::size_t link = 0; link < links.size(); ++link) {
      if (counts_in[link] == 0) {
        continue;
      }
      const LinkSums& sum = links[link];
      const double share = std::min(tempering, most_readings / std::max(1.0, sum.readings));
      if (link == 0) {
        base_share = share;
      }
      for (std::size_t a = 0; a < sum.indices.size(); ++a) {
        g[sum.indices[a]] += share * sum.g[static_cast<Eigen::Index>(a)];
        for (std::size_t b = 0; b <= a; ++b) {
          const double value = share * sum.H(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
          H(sum.indices[a], sum.indices[b]) += value;
          if (a != b) {
            H(sum.indices[b], sum.indices[a]) += value;
          }
        }
      }
    }
  }

  Eigen::Vector3d pivot_map;
  std::vector<JointAxis> axes;
  std::vector<LinkSums> links;
  std::vector<LinkCounts> counts;
  std::map<std::array<int, 4>, geometry::Vector6d> shifts;  ///< by surface of the base: what its deviation does to g
  double base_share = 0.0;                                  ///< that the base's weights were taken with
  double squares_m = 0.0;
  int agreeing = 0;
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};

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

void JointSolver::look(const JointEstimates& estimates, const Freedom& freedom, double sigma_m, Equations& equations) {
  std::vector<Eigen::Isometry3d> T_map_part = tree_.partPoses(estimates.standing.joint_values);
  for (std::size_t part = 0; part < T_map_part.size(); ++part) {
    T_map_part[part] = estimates.standing.T_map_model * T_map_part[part];
    for (const int mover : tree_.links()[static_cast<std::size_t>(tree_.linkOf(static_cast<int>(part)))].chain) {
      T_map_part[part].pretranslate(estimates.shift_map[static_cast<std::size_t>(mover)]);
    }
  }
  for (std::size_t link = 1; link < equations.axes.size(); ++link) {
    for (const int mover : tree_.links()[link].chain) {
      equations.axes[link].origin_map += estimates.shift_map[static_cast<std::size_t>(mover)];
    }
  }
  model_.place(T_map_part);
  const render::View view = model_.look(T_map_camera_, scan_.camera);
  addSurfaces(view, sigma_m, equations);
  addOutlines(view, sigma_m, equations);
  equations.gather(config_.tempering, config_.most_readings, countingLinks(freedom));
  addPriors(estimates, equations);
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

void JointSolver::addSurfaces(const render::View& view, double sigma_m, Equations& equations) const {
  for (int v = 0; v < scan_.camera.height; ++v) {
    const int* parts = view.part.ptr<int>(v);
    const auto* depths_m = view.depth_m.ptr<float>(v);
    const auto* normals = view.normal_camera.ptr<cv::Vec3f>(v);
    for (int u = 0; u < scan_.camera.width; ++u) {
      if (parts[u] < 0) {
        continue;
      }
      const int link = tree_.linkOf(parts[u]);
      LinkCounts& counts = equations.counts[static_cast<std::size_t>(link)];
      ++counts.shown;
      const ScanPoint& seen = scan_.at(u, v);
      const auto reading_m = static_cast<double>(seen.point_camera.z());
      const Eigen::Vector3d normal_camera = Eigen::Vector3f(normals[u][0], normals[u][1], normals[u][2]).cast<double>();
      const Eigen::Vector3d ray = scan_.camera.ray(u, v);
      const double along = -normal_camera.dot(ray);
      if (reading_m <= 0.0 || along < kMinIncidenceCos * ray.norm()) {
        continue;
      }
      ++counts.read;
      const auto depth_m = static_cast<double>(depths_m[u]);
      const double noise_m = residualSigma_m(reading_m, along / ray.norm());
      ModelledPixel surface;
      surface.depth_m = depth_m;
      surface.sigma_m = std::hypot(noise_m, sigma_m) / along;
      surface.faces = seen.normal_camera.isZero() || seen.normal_camera.cast<double>().dot(normal_camera) > mixture_.minNormalCos();
      const double residual_m = along * (depth_m - reading_m);
      const bool is_near = std::abs(reading_m - depth_m) < 3.0 * surface.sigma_m;
      counts.agreeing += is_near && surface.faces ? 1 : 0;
      counts.nearer += !is_near && reading_m < depth_m ? 1 : 0;
      counts.behind += !is_near && reading_m > depth_m ? 1 : 0;
      const double variance = noise_m * noise_m + config_.surface_sigma_m * config_.surface_sigma_m;
      const double share = surface.faces ? mixture_.shareOfSurface(reading_m, surface) * (isInside(view, u, v) ? 1.0 : kOfRim) : 0.0;
      const double weight = share / variance;
      if (weight <= 0.0) {
        continue;
      }
      const Eigen::Vector3d normal_map = T_map_camera_.linear() * normal_camera;
      const Eigen::Vector3d model_map = T_map_camera_ * (depth_m * ray);
      LinkSums& sum = equations.links[static_cast<std::size_t>(link)];
      sum.readings += share;
      equations.add(tree_.links()[static_cast<std::size_t>(link)], sum, model_map, normal_map, residual_m, weight);
      if (is_near && surface.faces) {
        equations.squares_m += residual_m * residual_m;
        ++equations.agreeing;
      }
      if (link == 0) {
        const Eigen::Vector3i facing = (1.5 * normal_map).array().round().cast<int>();
        const auto shift = equations.shifts.try_emplace({0, facing.x(), facing.y(), facing.z()}, geometry::Vector6d::Zero()).first;
        shift->second += weight * config_.surface_sigma_m * sum.J.head<kBaseSize>();
      }
    }
  }
}

/// Outlines hold what slides along itself: a front that is seen from straight ahead.
void JointSolver::addOutlines(const render::View& view, double sigma_m, Equations& equations) const {
  std::vector<Pair> pairs;
  appendEdgePairs(view, scan_, edges_, T_map_camera_, 3.0 * sigma_m, pairs);
  for (const Pair& pair : pairs) {
    const int link = tree_.linkOf(pair.part);
    const double variance = pair.sigma_m * pair.sigma_m + config_.surface_sigma_m * config_.surface_sigma_m;
    const double residual_m = pair.residual_m();
    const double width_sq = variance + sigma_m * sigma_m;
    const double share = 1.0 / (1.0 + residual_m * residual_m / width_sq);
    const double weight = share * share / variance;
    LinkSums& sum = equations.links[static_cast<std::size_t>(link)];
    equations.add(tree_.links()[static_cast<std::size_t>(link)], sum, pair.model_map, pair.normal_map, residual_m, weight);
    if (link == 0) {
      const Eigen::Vector3i facing = (1.5 * pair.normal_map).array().round().cast<int>();
      const auto shift = equations.shifts.try_emplace({1, facing.x(), facing.y(), facing.z()}, geometry::Vector6d::Zero()).first;
      shift->second += weight * config_.surface_sigma_m * sum.J.head<kBaseSize>();
    }
  }
}

/// The base from where it is believed, and each joint from where the model has it.
void JointSolver::addPriors(const JointEstimates& estimates, Equations& equations) const {
  const Eigen::Isometry3d& T_map_model = estimates.standing.T_map_model;
  geometry::Vector6d off;
  off << T_map_model * pivot_model_ - T_map_prior_ * pivot_model_,
      geometry::logSo3(T_map_model.linear() * T_map_prior_.linear().transpose());
  const geometry::Vector6d information = sigmasOf(config_).cwiseAbs2().cwiseInverse();
  equations.H.diagonal().head<kBaseSize>() += information;
  equations.g.head<kBaseSize>() += information.cwiseProduct(off);
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
Eigen::VectorXd JointSolver::stepOf(const Equations& equations, const JointEstimates& estimates, const Freedom& freedom) const {
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
    const double sigma_m = config_.wide_sigma_m * std::pow(config_.surface_sigma_m / config_.wide_sigma_m, share);
    Equations equations(tree_, estimates.standing, estimates.standing.T_map_model * pivot_model_);
    look(estimates, freedom, sigma_m, equations);
    const Eigen::VectorXd step = stepOf(equations, estimates, freedom);
    apply(step, estimates);
    if (share == 1.0 && step.lpNorm<Eigen::Infinity>() < kSettled) {
      return round + 1;
    }
  }
  return config_.rounds;
}

SolverReport JointSolver::report(const JointEstimates& estimates, const Freedom& freedom) {
  Equations equations(tree_, estimates.standing, estimates.standing.T_map_model * pivot_model_);
  look(estimates, freedom, config_.surface_sigma_m, equations);
  const std::vector<int> free = freeIndices(freedom);
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd(equations.H(free, free)).ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  if (freedom.base) {
    geometry::Matrix6d surfaces = geometry::Matrix6d::Zero();
    for (const auto& [surface, shift] : equations.shifts) {
      surfaces += equations.base_share * equations.base_share * shift * shift.transpose();
    }
    const Eigen::MatrixXd gain = covariance.leftCols<kBaseSize>();
    covariance += gain * surfaces * gain.transpose();
  }
  SolverReport report;
  report.counts = equations.counts;
  report.rms_m = equations.agreeing > 0 ? std::sqrt(equations.squares_m / equations.agreeing) : 0.0;
  report.variances.assign(tree_.links().size(), 0.0);
  report.shared_variances.assign(tree_.links().size(), 0.0);
  for (std::size_t i = 0; i < freedom.links.size(); ++i) {
    const auto link = static_cast<std::size_t>(freedom.links[i]);
    const auto index = static_cast<Eigen::Index>((freedom.base ? kBaseSize : 0) + kLinkSize * static_cast<int>(i));
    const double of_axis_rad = config_.axis_sigma_deg * kDegree / std::sqrt(3.0);
    const bool is_turn = equations.axes[link].is_turn;
    report.shared_variances[link] = is_turn ? of_axis_rad * of_axis_rad : config_.axis_sigma_m * config_.axis_sigma_m;
    report.variances[link] = covariance(index, index) + (is_turn ? of_axis_rad * of_axis_rad : 0.0);
  }
  if (freedom.base) {
    const Eigen::Matrix3d R_model_map = estimates.standing.T_map_model.linear().transpose();
    geometry::Matrix6d from_pivot = geometry::Matrix6d::Zero();
    from_pivot.topLeftCorner<3, 3>() = R_model_map;
    from_pivot.topRightCorner<3, 3>() = -R_model_map * geometry::skew(estimates.standing.T_map_model.translation() - equations.pivot_map);
    from_pivot.bottomRightCorner<3, 3>() = R_model_map;
    report.base_covariance = from_pivot * covariance.topLeftCorner<kBaseSize, kBaseSize>() * from_pivot.transpose();
  }
  return report;
}

}  // namespace oikos::registration
