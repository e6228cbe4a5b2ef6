// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/surface_check.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/base/config_rules.h"
#include "core/render/view.h"
#include "registration/pairs.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Wilson and Hilferty's approximation of the quantile of chi squared (1931, doi:10.1073/pnas.17.12.684): within 2 % down to chances of
/// 1e-4.
double chiSquareQuantile(int freedoms, double normal_quantile) {
  const double k = 2.0 / (9.0 * freedoms);
  return freedoms * std::pow(1.0 - k + normal_quantile * std::sqrt(k), 3.0);
}

/// x with P(N(0,1) > x) = chance (Abramowitz & Stegun, 26.2.23; error below 4.5e-4).
double normalQuantile(double chance) {
  const double t = std::sqrt(-2.0 * std::log(chance));
  return t - (2.515517 + 0.802853 * t + 0.010328 * t * t) / (1.0 + 1.432788 * t + 0.189269 * t * t + 0.001308 * t * t * t);
}

/// What one reading says about the surface in its pixel.
enum class Says : unsigned char { kNothing, kThere, kThrough, kJustBefore, kBefore };

/// What the readings say, pixel by pixel.
class Testimony {
 public:
  Testimony(const render::View& view, const Scan& scan, const render::Scene& scene, const SurfaceCheckConfig& config)
      : width_(scan.camera.width),
        height_(scan.camera.height),
        surface_(scan.points.size(), -1),
        says_(scan.points.size(), Says::kNothing) {
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) {
        hear(view, scan, scene, config, u, v);
      }
    }
  }

  void count(std::vector<SurfaceCheck>& checks) const {
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) {
        if (surface_[at(u, v)] >= 0) {
          SurfaceCheck& check = checks[static_cast<std::size_t>(surface_[at(u, v)])];
          ++check.pixels;
          check.agreeing += says_[at(u, v)] == Says::kThere ? 1 : 0;
          check.before += says_[at(u, v)] == Says::kBefore ? 1 : 0;
          check.just_before += says_[at(u, v)] == Says::kJustBefore ? 1 : 0;
          check.through += says_[at(u, v)] == Says::kThrough && hasCompany(u, v) ? 1 : 0;
        }
      }
    }
  }

 private:
  [[nodiscard]] std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }

  /// Too grazing an angle says nothing.
  void hear(const render::View& view, const Scan& scan, const render::Scene& scene, const SurfaceCheckConfig& config, int u, int v) {
    constexpr double kMinIncidenceCos = 0.17;
    const int part = view.part.at<int>(v, u);
    const double depth_m = static_cast<double>(scan.at(u, v).point_camera.z());
    if (part < 0 || depth_m <= 0.0) {
      return;
    }
    const Eigen::Vector3d ray = scan.camera.ray(u, v);
    const auto& normal = view.normal_camera.at<cv::Vec3f>(v, u);
    const double along = Eigen::Map<const Eigen::Vector3f>(normal.val).cast<double>().dot(ray);
    if (-along < kMinIncidenceCos * ray.norm()) {
      return;
    }
    surface_[at(u, v)] = scene.parts()[static_cast<std::size_t>(part)].model;
    const double before_m = along * (depth_m - static_cast<double>(view.depth_m.at<float>(v, u)));
    const Eigen::Vector3f& seen = scan.at(u, v).normal_camera;
    const Eigen::Map<const Eigen::Vector3f> believed(normal.val);
    const bool is_turned = !seen.isZero() && seen.dot(believed) < static_cast<float>(std::cos(config.max_normal_deg * kDegree));
    const Says in_front = before_m > config.gate_m ? Says::kBefore : before_m > config.near_m ? Says::kJustBefore : Says::kThere;
    says_[at(u, v)] = before_m < -config.near_m ? Says::kThrough : is_turned && in_front == Says::kThere ? Says::kNothing : in_front;
  }

  /// Along an outline a pixel goes past it because the pose is a little off: what counts is where the surface around is gone, too.
  [[nodiscard]] bool hasCompany(int u, int v) const {
    int on_surface = 0;
    int through = 0;
    for (int y = std::max(0, v - 1); y <= std::min(height_ - 1, v + 1); ++y) {
      for (int x = std::max(0, u - 1); x <= std::min(width_ - 1, u + 1); ++x) {
        if (surface_[at(x, y)] == surface_[at(u, v)]) {
          ++on_surface;
          through += says_[at(x, y)] == Says::kThrough ? 1 : 0;
        }
      }
    }
    return through > 1 && 4 * through >= 3 * on_surface;
  }

  int width_;
  int height_;
  std::vector<int> surface_;  ///< -1: none, or no reading
  std::vector<Says> says_;
};

/// Solves the surface's own equations along what they observe.
void solveAlone(const std::vector<Pair>& pairs, const Motion& motion, const StepMatrix& joint, const SurfaceCheckConfig& config,
                SurfaceCheck& check) {
  const NormalEquations equations = sumUp(pairs, motion, {config.surface_sigma_m, config.normal_sigma_deg * kDegree, config.gate_m / 3.0});
  const Observability observability = observe(equations);
  const double scale = equations.weight > 0.0 ? std::max(1.0, equations.squares / equations.weight) : 1.0;
  check.own = Step::Zero(motion.dimension());
  Eigen::MatrixXd observed(motion.dimension(), 0);
  StepMatrix inverse = StepMatrix::Zero(motion.dimension(), motion.dimension());
  for (std::size_t i = 0; i < observability.ratio.size(); ++i) {
    if (observability.ratio[i] >= config.min_observability) {
      const auto v = observability.directions.col(static_cast<Eigen::Index>(i));
      check.own -= v * (v.dot(equations.g) / observability.ratio[i]);
      inverse += v * v.transpose() / observability.ratio[i];
      observed.conservativeResize(Eigen::NoChange, observed.cols() + 1);
      observed.col(observed.cols() - 1) = equations.H * v;  // what the part measures of a step
    }
  }
  if (observed.cols() == 0) {
    return;
  }
  const StepMatrix covariance = scale * inverse + inverse * equations.surfaces * inverse + joint;
  const Eigen::VectorXd measured = observed.transpose() * check.own;
  const Eigen::MatrixXd expected = observed.transpose() * covariance * observed;
  const double squared = measured.dot(expected.ldlt().solve(measured));
  check.contradiction = squared / chiSquareQuantile(static_cast<int>(observed.cols()), normalQuantile(config.chance));
}

/// Where most of what is near a surface lies on it, what stands before it is clutter; else the surface itself may have come forward.
void dropClutter(double near_m, std::vector<Pair>& pairs) {
  const auto is_before = [near_m](const Pair& pair) { return !pair.is_edge && pair.residual_m() > near_m; };
  if (2 * std::count_if(pairs.begin(), pairs.end(), is_before) <= static_cast<std::ptrdiff_t>(pairs.size())) {
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_before), pairs.end());
  }
}

void judge(const Motion& motion, const StepMatrix& joint, const SurfaceCheckConfig& config, std::vector<Pair>& pairs, SurfaceCheck& check) {
  dropClutter(config.near_m, pairs);
  if (static_cast<int>(pairs.size()) >= config.min_pixels) {
    check.judged = true;
    solveAlone(pairs, motion, joint, config, check);
  }
  if (check.visible() >= config.min_pixels) {
    check.judged = true;
    if (check.share() < config.min_share) {
      check.contradiction = std::max(check.contradiction, config.min_share / std::max(0.01, check.share()));
    }
  }
}

}  // namespace

std::vector<std::string> SurfaceCheckConfig::validate() const {
  base::ConfigRules rules;
  rules.greater("gate_m", gate_m, 0.0);
  rules.require(max_normal_deg > 0.0 && max_normal_deg <= 90.0, "max_normal_deg", max_normal_deg, "must be > 0 and <= 90");
  rules.atLeast("min_pixels", min_pixels, 6)
      .between("min_share", min_share, 0.0, 1.0)
      .greater("near_m", near_m, 0.0)
      .atLeast("surface_sigma_m", surface_sigma_m, 0.0)
      .greater("normal_sigma_deg", normal_sigma_deg, 0.0)
      .greater("min_observability", min_observability, 1.0);
  rules.require(chance > 0.0 && chance < 0.5, "chance", chance, "must be > 0 and < 0.5");
  return rules.messages();
}

std::vector<SurfaceCheck> checkSurfaces(const LandmarkScene& scene, const Motion& motion, const Scan& scan, const ScanEdges& edges,
                                        const StepMatrix& joint, const SurfaceCheckConfig& config, int threads) {
  render::ViewConfig view_config;
  view_config.with_normals = true;
  view_config.with_parts = true;
  view_config.threads = threads;
  const Eigen::Isometry3d T_map_camera = motion.T_map_camera();
  const render::View view = render::renderView(scene.scene(), render::CameraRays(scan.camera), {T_map_camera, {}}, view_config);
  std::vector<SurfaceCheck> checks(scene.surfaces().size());
  Testimony(view, scan, scene.scene(), config).count(checks);
  std::vector<std::vector<Pair>> pairs(checks.size());
  const PairRules rules{config.gate_m, std::cos(config.max_normal_deg * kDegree)};
  std::vector<Pair> all = projectivePairs(view, scan, T_map_camera, rules).pairs;
  appendEdgePairs(view, scan, edges, T_map_camera, config.near_m, all);
  for (const Pair& pair : all) {
    pairs[static_cast<std::size_t>(scene.scene().parts()[static_cast<std::size_t>(pair.part)].model)].push_back(pair);
  }
  for (std::size_t s = 0; s < checks.size(); ++s) {
    judge(motion, joint, config, pairs[s], checks[s]);
  }
  return checks;
}

}  // namespace oikos::registration
