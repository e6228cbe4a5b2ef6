// SPDX-License-Identifier: Apache-2.0
#include "tests/mapping/graph/synthetic_drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/analytic_room.h"

namespace oikos::mapping {

std::vector<Eigen::Isometry3d> turnAround(double begin_deg, double end_deg, int frames) {
  constexpr double kRadius_m = 0.4;
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < frames; ++i) {
    const double yaw_rad = (begin_deg + (end_deg - begin_deg) * i / frames) * std::numbers::pi / 180.0;
    const Eigen::Vector3d outwards(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    const Eigen::Vector3d eye = kRadius_m * outwards + 1.2 * Eigen::Vector3d::UnitZ();
    poses.push_back(test::lookAt(eye, eye + outwards - 0.35 * Eigen::Vector3d::UnitZ()));
  }
  return poses;
}

void append(std::vector<Eigen::Isometry3d>& drive, const std::vector<Eigen::Isometry3d>& more) {
  drive.insert(drive.end(), more.begin(), more.end());
}

DriveRun::DriveRun(const test::SyntheticRecording& recording, const FrontEndConfig& config, const WheelOdometry& odometry)
    : recording_(recording),
      config_(config),
      images_([&recording](int frame) { return recording.read(frame, recording::Channels::kGray).gray; }, config.pyramid_levels, 48) {
  FrontEnd front_end({recording.camera(), odometry, images_}, config_, {}, 0);
  for (int i = 0; i < recording.frameCount(); ++i) {
    front_end.add(recording.read(i, recording::Channels::kGray));
  }
  drive = front_end.finish();
}

BackEndResult DriveRun::optimise(const std::vector<MotionPrior>& priors, const BackEndConfig& config, int threads) {
  const BackEndTools tools{
      recording_.camera(),    config_.follower, images_, [this](int f) { return recording_.read(f, recording::Channels::kGray); },
      config_.pyramid_levels, threads,          {}};
  return optimiseDrive(drive, priors, config, tools);
}

std::vector<double> DriveRun::errors_m(const std::vector<Eigen::Isometry3d>& T_world_frame) const {
  const recording::Trajectory truth = recording_.truth();
  std::vector<double> errors;
  for (std::size_t i = 0; i < T_world_frame.size(); ++i) {
    const Eigen::Isometry3d T_first_frame = T_world_frame.front().inverse() * T_world_frame[i];
    const Eigen::Isometry3d T_first_true = truth.front().T_map_camera.inverse() * truth[i].T_map_camera;
    errors.push_back((T_first_frame.translation() - T_first_true.translation()).norm());
  }
  return errors;
}

double DriveRun::worstError_m(const std::vector<Eigen::Isometry3d>& T_world_frame) const {
  const std::vector<double> errors = errors_m(T_world_frame);
  return *std::max_element(errors.begin(), errors.end());
}

int DriveRun::keyframes() const {
  return static_cast<int>(std::count_if(drive.graph.nodes.begin(), drive.graph.nodes.end(), [](const Node& n) { return n.keyframe; }));
}

int DriveRun::count(TrackingStatus status) const {
  return static_cast<int>(
      std::count_if(drive.frames.begin(), drive.frames.end(), [&](const TrackedFrame& f) { return f.status == status; }));
}

}  // namespace oikos::mapping
