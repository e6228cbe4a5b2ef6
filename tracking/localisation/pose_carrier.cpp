// SPDX-License-Identifier: Apache-2.0
// Frame-to-keyframe odometry with the parts of the mapper's front end (landmarks by corners, followed by patches). Errors of the noise are
// independent from host to host; those of scale (depth, wheels) are the same all the way, so that their deviation grows with the way, and
// not with its root.
#include "tracking/localisation/pose_carrier.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/config_rules.h"
#include "core/base/degrees.h"
#include "mapping/odometry/rotation_alignment.h"

namespace oikos::tracking {

namespace {

using geometry::Matrix6d;

/// What a deviation in proportion to the way gains from one way to a longer one.
Matrix6d drift(const mapping::WheelWay& before, const mapping::WheelWay& after, double way_share, double turn_share) {
  const auto gained = [](double from, double to, double share) { return share * share * (to * to - from * from); };
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>().setConstant(gained(before.way_m, after.way_m, way_share));
  covariance.diagonal().tail<3>().setConstant(gained(before.turn_rad, after.turn_rad, turn_share));
  return covariance;
}

/// A pose and a motion from it, with the covariances of both.
CarriedPose moved(const CarriedPose& from, const Eigen::Isometry3d& T_from_to, const Matrix6d& motion) {
  const Matrix6d carried = geometry::adjoint(T_from_to.inverse());
  return {from.T_map_camera * T_from_to, carried * from.covariance * carried.transpose() + motion};
}

}  // namespace

std::vector<std::string> CarryConfig::validate() const {
  return base::ConfigRules()
      .greater("max_sigma_m", max_sigma_m, 0.0)
      .greater("max_sigma_deg", max_sigma_deg, 0.0)
      .greater("max_gap_s", max_gap_s, 0.0)
      .between("fresh_share", fresh_share, 0.0, 1.0)
      .atLeast("way_share", way_share, 0.0)
      .atLeast("turn_share", turn_share, 0.0)
      .atLeast("wheel_way_share", wheel_way_share, 0.0)
      .atLeast("wheel_turn_share", wheel_turn_share, 0.0)
      .atLeast("wheel_sigma_m", wheel_sigma_m, 0.0)
      .atLeast("wheel_sigma_deg", wheel_sigma_deg, 0.0)
      .messages();
}

PoseCarrier::PoseCarrier(const camera::PinholeCamera& camera, const mapping::WheelOdometry* odometry, int pyramid_levels,
                         const CarryConfig& config)
    : camera_(camera), odometry_(odometry), pyramid_levels_(pyramid_levels), config_(config) {}

void PoseCarrier::start(const camera::RgbdFrame& frame, const CarriedPose& known) {
  const double gap_s = static_cast<double>(frame.stamp_ns - last_ns_) * 1e-9;
  T_before_last_ = host_ && gap_s <= config_.max_gap_s ? last_.T_map_camera.inverse() * known.T_map_camera : Eigen::Isometry3d::Identity();
  host_ = Host{frame, known, {}, nullptr, {}};
  last_ = known;
  way_ = {};
  last_ns_ = frame.stamp_ns;
  last_pyramid_ = nullptr;
}

std::optional<CarriedPose> PoseCarrier::carry(const camera::RgbdFrame& frame) {
  if (!host_) {
    return std::nullopt;
  }
  const auto T_last_now = odometry_ != nullptr ? odometry_->findMotion(last_ns_, frame.stamp_ns) : std::nullopt;
  std::optional<Step> step;
  Pyramid pyramid;
  if (T_last_now || static_cast<double>(frame.stamp_ns - last_ns_) * 1e-9 <= config_.max_gap_s) {
    prepare(*host_);
    pyramid = std::make_shared<const mapping::ImagePyramid>(frame.gray, pyramid_levels_);
    step = byPictures(*host_, frame, pyramid, T_last_now);
  }
  if (!step) {
    step = byWheels(T_last_now);
  }
  if (!step) {
    return std::nullopt;  // one to come may show the host's landmarks again
  }
  if (!isGoodEnough(step->pose)) {
    host_.reset();
    return std::nullopt;
  }
  if (!step->is_fresh) {
    host_ = Host{frame, step->pose, step->way, pyramid, {}};
  }
  T_before_last_ = last_.T_map_camera.inverse() * step->pose.T_map_camera;
  last_ = step->pose;
  way_ = step->way;
  last_ns_ = frame.stamp_ns;
  last_pyramid_ = pyramid;
  return last_;
}

void PoseCarrier::prepare(Host& host) const {
  if (!host.pyramid) {
    host.pyramid = std::make_shared<const mapping::ImagePyramid>(host.frame.gray, pyramid_levels_);
  }
  if (host.landmarks.empty()) {
    host.landmarks = mapping::detectCorners(host.frame, {}, config_.corners);
  }
}

std::optional<PoseCarrier::Step> PoseCarrier::byPictures(const Host& host, const camera::RgbdFrame& frame, const Pyramid& pyramid,
                                                         const std::optional<Eigen::Isometry3d>& T_last_now_wheels) const {
  const Eigen::Isometry3d T_last_now = T_last_now_wheels ? *T_last_now_wheels : expectedMotion(host, pyramid);
  const Eigen::Isometry3d T_host_last = host.pose.T_map_camera.inverse() * last_.T_map_camera;
  std::vector<mapping::Candidate> candidates;
  candidates.reserve(host.landmarks.size());
  for (std::size_t i = 0; i < host.landmarks.size(); ++i) {
    candidates.push_back({static_cast<int>(i), &host.landmarks[i], Eigen::Isometry3d::Identity(), host.pyramid.get()});
  }
  const mapping::FollowResult seen =
      mapping::followLandmarks({&camera_, pyramid.get(), &frame.depth_m}, candidates, T_host_last * T_last_now, config_.follower);
  if (!seen.tracked) {
    return std::nullopt;
  }
  const Eigen::Isometry3d& T_host_now = seen.pose.T_world_camera;
  Step step;
  step.way = way_;
  step.way.add(T_host_last.inverse() * T_host_now);
  if (T_last_now_wheels) {
    mapping::WheelWay since;
    since.add(T_last_now);
    if (!config_.wheels.allows((T_host_last * T_last_now).inverse() * T_host_now, since)) {
      return std::nullopt;
    }
  }
  step.pose = moved(host.pose, T_host_now, seen.pose.covariance + drift(host.way, step.way, config_.way_share, config_.turn_share));
  step.is_fresh = static_cast<double>(seen.pose.inliers) >= config_.fresh_share * static_cast<double>(host.landmarks.size());
  return step;
}

std::optional<PoseCarrier::Step> PoseCarrier::byWheels(const std::optional<Eigen::Isometry3d>& T_last_now_wheels) const {
  if (!T_last_now_wheels) {
    return std::nullopt;
  }
  Step step;
  step.way = way_;
  step.way.add(*T_last_now_wheels);
  Matrix6d motion = drift(way_, step.way, config_.wheel_way_share, config_.wheel_turn_share);
  const double sigma_rad = config_.wheel_sigma_deg * base::kRadPerDeg;
  motion.diagonal().head<3>().array() += config_.wheel_sigma_m * config_.wheel_sigma_m;
  motion.diagonal().tail<3>().array() += sigma_rad * sigma_rad;
  step.pose = moved(last_, *T_last_now_wheels, motion);
  return step;
}

/// The last motion once more, its turn corrected by the images.
Eigen::Isometry3d PoseCarrier::expectedMotion(const Host& host, const Pyramid& pyramid) const {
  Eigen::Isometry3d T_last_now = T_before_last_;
  const mapping::ImagePyramid& before = last_pyramid_ ? *last_pyramid_ : *host.pyramid;
  const mapping::RotationAlignment turn = mapping::alignRotation(before, *pyramid, camera_, T_before_last_.linear());
  if (turn.converged) {
    T_last_now.linear() = turn.R_previous_current;
  }
  return T_last_now;
}

bool PoseCarrier::isGoodEnough(const CarriedPose& pose) const {
  const geometry::Vector6d variance = pose.covariance.diagonal();
  const double max_rad = config_.max_sigma_deg * base::kRadPerDeg;
  return variance.head<3>().maxCoeff() <= config_.max_sigma_m * config_.max_sigma_m && variance.tail<3>().maxCoeff() <= max_rad * max_rad;
}

}  // namespace oikos::tracking
