// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mapping/graph/back_end.h"
#include "mapping/graph/front_end.h"
#include "mapping/graph/keyframe_images.h"
#include "tests/support/textured_recording.h"

namespace oikos::mapping {

/// A camera in the middle of the furnished room that turns from heading to heading, looking a little down, on a circle of 0.4 m:
/// `frames` poses from `begin_deg` on, `end_deg` left out.
[[nodiscard]] std::vector<Eigen::Isometry3d> turnAround(double begin_deg, double end_deg, int frames);
void append(std::vector<Eigen::Isometry3d>& drive, const std::vector<Eigen::Isometry3d>& more);

/// The front end over a whole recording, and the back end if it is asked for.
class DriveRun {
 public:
  explicit DriveRun(const test::SyntheticRecording& recording, const FrontEndConfig& config = {}, const WheelOdometry& odometry = {});
  BackEndResult optimise(const std::vector<MotionPrior>& priors = {}, const BackEndConfig& config = {}, int threads = 1);

  /// Distance of each frame's pose from where it truly was, both seen from the first frame.
  [[nodiscard]] std::vector<double> errors_m(const std::vector<Eigen::Isometry3d>& T_world_frame) const;
  [[nodiscard]] double worstError_m(const std::vector<Eigen::Isometry3d>& T_world_frame) const;
  [[nodiscard]] int keyframes() const;
  [[nodiscard]] int count(TrackingStatus status) const;

  FrontEndResult drive;

 private:
  const test::SyntheticRecording& recording_;
  FrontEndConfig config_;
  KeyframeImages images_;
};

}  // namespace oikos::mapping
