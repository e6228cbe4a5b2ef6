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

/// The surface of each pixel, -1 where there is none, no reading, or one at too grazing an angle.
int surfaceAt(const render::View& view, const Scan& scan, const render::Scene& scene, int u, int v) {
  constexpr float kMinIncidenceCos = 0.17F;
  const int part = view.part.at<int>(v, u);
  if (part < 0 || scan.at(u, v).point_camera.z() <= 0.0F) {
    return -1;
  }
  const Eigen::Vector3f ray = scan.camera.ray(u, v).cast<float>();
  const auto& normal = view.normal_camera.at<cv::Vec3f>(v, u);
  const float along = -(normal[0] * ray.x() + normal[1] * ray.y() + normal[2] * ray.z());
  return along < kMinIncidenceCos * ray.norm() ? -1 : scene.parts()[static_cast<std::size_t>(part)].model;
}

/// All readings by surface, and those that go through it: what is before a surface hides it and does not speak about it.
void countReadings(const render::View& view, const Scan& scan, const render::Scene& scene, double near_m,
                   std::vector<SurfaceCheck>& checks) {
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      const int surface = surfaceAt(view, scan, scene, u, v);
      if (surface >= 0) {
        SurfaceCheck& check = checks[static_cast<std::size_t>(surface)];
        ++check.pixels;
        const double behind_m = static_cast<double>(scan.at(u, v).point_camera.z() - view.depth_m.at<float>(v, u));
        check.visible += behind_m > near_m ? 1 : 0;
      }
    }
  }
}

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
  countReadings(view, scan, scene.scene(), config.near_m, checks);
  std::vector<std::vector<Pair>> pairs(checks.size());
  const PairRules rules{config.gate_m, std::cos(config.max_normal_deg * kDegree)};
  const Eigen::Isometry3d T_camera_map = T_map_camera.inverse();
  std::vector<Pair> all = projectivePairs(view, scan, T_map_camera, rules).pairs;
  appendEdgePairs(view, scan, edges, T_map_camera, config.near_m, all);
  for (const Pair& pair : all) {
    const auto surface = static_cast<std::size_t>(scene.scene().parts()[static_cast<std::size_t>(pair.part)].model);
    pairs[surface].push_back(pair);
    if (pair.is_edge) {
      continue;
    }
    const bool agrees = std::abs(pair.residual_m()) < config.near_m;
    checks[surface].agreeing += agrees ? 1 : 0;
    const double behind_m = (T_camera_map.linear() * (pair.scan_map - pair.model_map)).z();
    checks[surface].visible += behind_m > config.near_m ? 0 : 1;  // those are counted already
  }
  for (std::size_t s = 0; s < checks.size(); ++s) {
    checks[s].judged = checks[s].visible >= config.min_pixels;
    if (checks[s].judged && static_cast<int>(pairs[s].size()) >= config.min_pixels) {
      solveAlone(pairs[s], motion, joint, config, checks[s]);
    }
    if (checks[s].judged && checks[s].share() < config.min_share) {
      checks[s].contradiction = std::max(checks[s].contradiction, config.min_share / std::max(0.01, checks[s].share()));
    }
  }
  return checks;
}

}  // namespace oikos::registration
