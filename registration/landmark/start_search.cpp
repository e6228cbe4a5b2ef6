// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/start_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/config_rules.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSame_m = 0.04;
constexpr double kSame_rad = 1.5 * kDegree;

struct Screened {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  double score = 0.0;
};

bool isSame(const Screened& a, const Screened& b) {
  const Eigen::Isometry3d T_a_b = a.T_map_camera.inverse() * b.T_map_camera;
  return T_a_b.translation().norm() < kSame_m && Eigen::AngleAxisd(T_a_b.linear()).angle() < kSame_rad;
}

/// Steps of x, y and yaw to the corners and sides of a box about the prior that looks where the camera looks; its middle is the first.
std::vector<Step> gridAbout(const CameraPrior& prior, const StartSearchConfig& config) {
  const Eigen::Vector2d ahead = prior.T_map_camera.linear().col(2).head<2>().normalized();
  const Eigen::Vector2d aside(ahead.y(), -ahead.x());
  const double way_m = config.reach * prior.sigma_m;
  std::vector<Step> grid;
  for (const double turn : {0.0, -1.0, 1.0}) {
    for (const double right : {0.0, -1.0, 1.0}) {
      for (const double forward : {0.0, -1.0, 1.0}) {
        Step step(3);
        step.head<2>() = way_m * (forward * ahead + right * aside);
        step[2] = turn * config.turn_reach * prior.sigma_rad;
        grid.push_back(step);
      }
    }
  }
  return grid;
}

int readingsOf(const Scan& scan) {
  return static_cast<int>(
      std::count_if(scan.points.begin(), scan.points.end(), [](const ScanPoint& point) { return point.point_camera.z() > 0.0F; }));
}

AlignConfig quickConfig(AlignConfig config, const StartSearchConfig& search) {
  config.coarse_iterations = search.iterations;
  config.fine_iterations = 2;
  config.min_inliers = std::max(6, config.min_inliers / (search.thinning * search.thinning));
  return config;
}

}  // namespace

std::vector<std::string> StartSearchConfig::validate() const {
  return base::ConfigRules()
      .atLeast("wide_m", wide_m, 0.0)
      .atLeast("wide_deg", wide_deg, 0.0)
      .greater("reach", reach, 0.0)
      .greater("turn_reach", turn_reach, 0.0)
      .atLeast("thinning", thinning, 1)
      .atLeast("iterations", iterations, 1)
      .atLeast("best", best, 1)
      .atLeast("through_cost", through_cost, 0.0)
      .atLeast("before_cost", before_cost, 0.0)
      .atLeast("prior_share", prior_share, 0.0)
      .messages();
}

bool hasOtherStarts(const CameraPrior& prior, const StartSearchConfig& config) {
  return std::numbers::sqrt2 * config.reach * prior.sigma_m >= kSame_m || config.turn_reach * prior.sigma_rad >= kSame_rad;
}

bool isWide(const CameraPrior& prior, const StartSearchConfig& config) {
  return prior.sigma_m > config.wide_m || prior.sigma_rad > config.wide_deg * kDegree;
}

double explains(const Readings& readings, const Eigen::Isometry3d& T_map_camera, const CameraPrior& prior,
                const StartSearchConfig& config) {
  const Step back = stepToPrior(prior, T_map_camera);
  const double deviations_sq = back.dot(planarCovariance(prior).ldlt().solve(back));
  const double explained = readings.on - config.through_cost * readings.through - config.before_cost * readings.before;
  return explained / std::max(1, readings.all) - config.prior_share * deviations_sq;
}

std::vector<Eigen::Isometry3d> findStarts(const LandmarkScene& scene, const Scan& scan, const CameraPrior& prior,
                                          const AlignConfig& align_config, const StartSearchConfig& config) {
  const Scan thin = thinned(scan, config.thinning);
  const int readings = readingsOf(thin);
  const AlignConfig quick = quickConfig(align_config, config);
  std::vector<Screened> found;
  for (const Step& step : gridAbout(prior, config)) {
    CameraMotion motion(scene.scene(), prior.T_map_camera, PoseFreedom::kPlanar, prior.robot_camera);
    motion.apply(step);
    const AlignResult fit = align(motion, thin, quick);
    found.push_back(
        {motion.T_map_camera(), explains({readings, fit.inliers, fit.through, fit.before}, motion.T_map_camera(), prior, config)});
  }
  std::stable_sort(found.begin(), found.end(), [](const Screened& a, const Screened& b) { return a.score > b.score; });
  std::vector<Screened> kept;
  for (const Screened& one : found) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Screened& other) { return isSame(one, other); });
    if (is_new && static_cast<int>(kept.size()) < config.best) {
      kept.push_back(one);
    }
  }
  std::vector<Eigen::Isometry3d> starts(kept.size());
  std::transform(kept.begin(), kept.end(), starts.begin(), [](const Screened& one) { return one.T_map_camera; });
  return starts;
}

}  // namespace oikos::registration
