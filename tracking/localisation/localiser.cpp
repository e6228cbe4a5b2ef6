// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/localiser.h"

#include "core/base/config_rules.h"
#include "core/base/degrees.h"

namespace oikos::tracking {

std::vector<std::string> LocaliseConfig::validate() const {
  return base::ConfigRules()
      .greater("prior_sigma_m", prior_sigma_m, 0.0)
      .greater("prior_sigma_deg", prior_sigma_deg, 0.0)
      .greater("map_prior_sigma_m", map_prior_sigma_m, 0.0)
      .greater("map_prior_sigma_deg", map_prior_sigma_deg, 0.0)
      .messages();
}

Localiser::Localiser(const LocaliserTools& tools, const LocaliseConfig& config) : tools_(tools), config_(config) {
  if (tools.relocaliser != nullptr) {
    tracker_.emplace(*tools.relocaliser);
  }
}

LocatedPose Localiser::add(const camera::RgbdFrame& frame) {
  LocatedPose located = locate(frame);
  refine(frame, located);
  if (located.source != PoseSource::kNone) {
    last_ = located;
  }
  return located;
}

LocatedPose Localiser::addUnrefined(const camera::RgbdFrame& frame) {
  LocatedPose located = locate(frame);
  if (located.source == PoseSource::kNone) {
    refine(frame, located);
  }
  if (located.source != PoseSource::kNone) {
    last_ = located;
  }
  return located;
}

LocatedPose Localiser::locate(const camera::RgbdFrame& frame) {
  LocatedPose located;
  located.frame = frame.index;
  located.stamp_ns = frame.stamp_ns;
  const std::optional<Eigen::Isometry3d> T_map_camera_prior = predict(frame.stamp_ns);
  located.T_map_camera_before = T_map_camera_prior;
  if (tracker_) {
    located.in_map = tracker_->add(frame, T_map_camera_prior);
    if (located.in_map.found()) {
      located.source = PoseSource::kMap;
      located.T_map_camera = located.in_map.T_map_camera;
      located.covariance = located.in_map.covariance;
      located.T_map_camera_before = located.T_map_camera;
    }
  }
  return located;
}

/// From what was given, else from the last pose, as far as the wheels know what came after it.
std::optional<Eigen::Isometry3d> Localiser::predict(std::int64_t stamp_ns) const {
  if (tools_.prior != nullptr) {
    if (const auto T_map_camera = tools_.prior->findCamera(stamp_ns)) {
      return T_map_camera;
    }
  }
  if (!last_) {
    return std::nullopt;
  }
  const auto T_last_now = tools_.odometry != nullptr ? tools_.odometry->findMotion(last_->stamp_ns, stamp_ns) : std::nullopt;
  return T_last_now ? last_->T_map_camera * *T_last_now : last_->T_map_camera;
}

void Localiser::refine(const camera::RgbdFrame& frame, LocatedPose& located) const {
  if (tools_.furniture == nullptr || !located.T_map_camera_before || located.landmarks) {
    return;
  }
  const bool in_map = located.source == PoseSource::kMap;
  registration::CameraPrior prior;
  prior.T_map_camera = *located.T_map_camera_before;
  prior.robot_camera = tools_.T_base_camera.inverse().translation();
  prior.sigma_m = in_map ? config_.map_prior_sigma_m : config_.prior_sigma_m;
  prior.sigma_rad = (in_map ? config_.map_prior_sigma_deg : config_.prior_sigma_deg) * base::kRadPerDeg;
  const registration::Scan scan = registration::makeScan(frame.depth_m, tools_.camera, config_.scan);
  located.landmarks = registration::refineByLandmarks(*tools_.furniture, scan, prior, config_.landmarks, tools_.only);
  if (located.landmarks->status == registration::RefinementStatus::kRefined) {
    located.source = PoseSource::kLandmarks;
    located.T_map_camera = located.landmarks->T_map_camera;
    located.covariance = located.landmarks->covariance;
  }
}

}  // namespace oikos::tracking
