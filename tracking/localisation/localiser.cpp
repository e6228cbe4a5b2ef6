// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/localiser.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

Localiser::Localiser(const LocaliserTools& tools, const LocaliseConfig& config)
    : tools_(tools), config_(config), carrier_(tools.camera, tools.odometry, config.map.pyramid_levels, config.carry) {
  if (tools.relocaliser != nullptr) {
    tracker_.emplace(*tools.relocaliser);
  }
}

LocatedPose Localiser::add(const camera::RgbdFrame& frame) {
  LocatedPose located = locate(frame);
  refine(frame, located);
  return concluded(frame, std::move(located));
}

LocatedPose Localiser::addUnrefined(const camera::RgbdFrame& frame) {
  LocatedPose located = locate(frame);
  if (!located.isFound()) {
    refine(frame, located);
  }
  return concluded(frame, std::move(located));
}

/// A pose that was found is where the next ones are carried from.
LocatedPose Localiser::concluded(const camera::RgbdFrame& frame, LocatedPose located) {
  if (located.source == PoseSource::kNone) {
    take(carrier_.carry(frame), located);
  }
  is_carrying_ = !located.isFound();
  if (located.isFound()) {
    carrier_.start(frame, {located.T_map_camera, located.covariance});
  }
  if (located.source != PoseSource::kNone) {
    last_ = located;
  }
  return located;
}

void Localiser::take(const std::optional<CarriedPose>& carried, LocatedPose& located) {
  if (carried) {
    located.source = PoseSource::kCarried;
    located.T_map_camera = carried->T_map_camera;
    located.covariance = carried->covariance;
  }
}

LocatedPose Localiser::locate(const camera::RgbdFrame& frame) {
  LocatedPose located;
  located.frame = frame.index;
  located.stamp_ns = frame.stamp_ns;
  located.T_map_camera_before = tools_.prior != nullptr ? tools_.prior->findCamera(frame.stamp_ns) : std::nullopt;
  if (!located.T_map_camera_before && is_carrying_) {
    take(carrier_.carry(frame), located);
    located.T_map_camera_before = located.source == PoseSource::kCarried ? std::optional(located.T_map_camera) : std::nullopt;
  }
  if (!located.T_map_camera_before) {
    located.T_map_camera_before = predict(frame.stamp_ns);
  }
  if (tracker_) {
    located.in_map = tracker_->add(frame, located.T_map_camera_before);
    if (located.in_map.found()) {
      located.source = PoseSource::kMap;
      located.T_map_camera = located.in_map.T_map_camera;
      located.covariance = located.in_map.covariance;
      located.T_map_camera_before = located.T_map_camera;
    }
  }
  return located;
}

/// From the last pose, as far as the wheels know what came after it.
std::optional<Eigen::Isometry3d> Localiser::predict(std::int64_t stamp_ns) const {
  if (!last_) {
    return std::nullopt;
  }
  const auto T_last_now = tools_.odometry != nullptr ? tools_.odometry->findMotion(last_->stamp_ns, stamp_ns) : std::nullopt;
  return T_last_now ? last_->T_map_camera * *T_last_now : last_->T_map_camera;
}

registration::CameraPrior Localiser::priorOf(const LocatedPose& located, const Eigen::Isometry3d& T_map_camera) const {
  registration::CameraPrior prior;
  prior.T_map_camera = T_map_camera;
  prior.robot_camera = tools_.T_base_camera.inverse().translation();
  prior.sigma_m = config_.map_prior_sigma_m;
  prior.sigma_rad = config_.map_prior_sigma_deg * base::kRadPerDeg;
  if (located.source == PoseSource::kNone) {
    prior.sigma_m = config_.prior_sigma_m;
    prior.sigma_rad = config_.prior_sigma_deg * base::kRadPerDeg;
  } else if (located.source == PoseSource::kCarried) {
    const Eigen::Matrix3d R = located.T_map_camera.linear();
    const Eigen::Matrix3d place_map = R * located.covariance.topLeftCorner<3, 3>() * R.transpose();
    const Eigen::Matrix3d turn_map = R * located.covariance.bottomRightCorner<3, 3>() * R.transpose();
    prior.sigma_m = std::max(prior.sigma_m, std::sqrt(std::max(place_map(0, 0), place_map(1, 1))));
    prior.sigma_rad = std::max(prior.sigma_rad, std::sqrt(turn_map(2, 2)));
  }
  return prior;
}

void Localiser::refine(const camera::RgbdFrame& frame, LocatedPose& located) const {
  if (tools_.furniture == nullptr || !located.T_map_camera_before || located.landmarks) {
    return;
  }
  const registration::CameraPrior prior = priorOf(located, *located.T_map_camera_before);
  const registration::Scan scan = registration::makeScan(frame.depth_m, tools_.camera, config_.scan);
  located.landmarks = registration::refineByLandmarks(*tools_.furniture, scan, prior, config_.landmarks, tools_.only);
  if (located.landmarks->status == registration::RefinementStatus::kRefined) {
    located.source = PoseSource::kLandmarks;
    located.T_map_camera = located.landmarks->T_map_camera;
    located.covariance = located.landmarks->covariance;
  }
}

}  // namespace oikos::tracking
