// SPDX-License-Identifier: Apache-2.0
#include "mapping/relocalise/relocaliser.h"

#include "mapping/graph/local_map.h"
#include "mapping/odometry/features.h"
#include "mapping/odometry/relative_motion.h"

namespace oikos::mapping {

namespace {

constexpr double kRadPerDeg = 3.14159265358979 / 180.0;

geometry::Matrix6d mapCovariance(const RelocaliseConfig& config) {
  const double sigma_rad = config.map_sigma_deg * kRadPerDeg;
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(config.map_sigma_m * config.map_sigma_m);
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(sigma_rad * sigma_rad);
  return covariance;
}

}  // namespace

LocateResult Relocaliser::findNear(const LocatedFrame& located, const Eigen::Isometry3d& T_map_camera) const {
  LocateResult result;
  result.status = LocateStatus::kGeometryDisagrees;
  const std::vector<int> landmarks = landmarksInView(map_, T_map_camera, located.frame.depth_m, config_);
  const FollowResult seen = followInMap(map_, located, landmarks, T_map_camera, config_);
  result.landmarks = seen.in_view;
  if (!seen.tracked) {
    return result;
  }
  result.status = LocateStatus::kTracked;
  result.T_map_camera = seen.pose.T_world_camera;
  result.covariance = seen.pose.covariance + mapCovariance(config_);
  result.keyframe = mainHost(map_.graph(), seen.observations);
  result.inliers = seen.pose.inliers;
  result.rms_px = seen.pose.rms_px;
  return result;
}

LocateResult Relocaliser::find(const LocatedFrame& located) const {
  const Features features = extractFeatures(located.frame, map_.camera(), config_.features);
  LocateResult result;
  for (const PlaceIndex::Candidate& place : map_.places().query(features, config_.candidates)) {
    if (place.votes < config_.min_votes) {
      break;
    }
    result.status = LocateStatus::kGeometryDisagrees;
    const Features& old = map_.features(place.place);
    const std::uint64_t seed = seed_ ^ (static_cast<std::uint64_t>(located.frame.index) << 32U) ^ static_cast<std::uint64_t>(place.place);
    const RelativeMotion motion = estimateMotion(old, features, matchFeatures(old, features), map_.camera(), config_.motion, seed);
    if (motion.status != MotionStatus::kConverged) {
      continue;
    }
    const Eigen::Isometry3d T_map_camera = map_.graph().nodes[static_cast<std::size_t>(place.place)].T_world_camera * motion.T_a_b;
    LocateResult found = findNear(located, T_map_camera);
    if (found.found()) {
      found.status = LocateStatus::kRelocalised;
      return found;
    }
  }
  return result;
}

}  // namespace oikos::mapping
