// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/pose_prior.h"

#include <algorithm>
#include <cstdlib>

#include "core/geometry/se3.h"

namespace oikos::tracking {

namespace {

constexpr std::int64_t kSameStamp_ns = 1'000'000;
constexpr std::int64_t kLongestGap_ns = 500'000'000;

}  // namespace

PosePrior::PosePrior(const recording::Trajectory& T_map_base, const Eigen::Isometry3d& T_base_camera) : T_map_camera_(T_map_base) {
  for (recording::StampedPose& pose : T_map_camera_) {
    pose.T_map_camera = pose.T_map_camera * T_base_camera;
  }
}

PosePrior::PosePrior(const Eigen::Isometry3d& T_map_base, std::int64_t stamp_ns, const Eigen::Isometry3d& T_base_camera)
    : T_map_camera_{{stamp_ns, T_map_base * T_base_camera}} {}

std::optional<Eigen::Isometry3d> PosePrior::findCamera(std::int64_t stamp_ns) const {
  const auto after = std::find_if(T_map_camera_.begin(), T_map_camera_.end(),
                                  [&](const recording::StampedPose& pose) { return pose.stamp_ns >= stamp_ns - kSameStamp_ns; });
  if (after == T_map_camera_.end()) {
    return std::nullopt;
  }
  if (std::abs(after->stamp_ns - stamp_ns) <= kSameStamp_ns) {
    return after->T_map_camera;
  }
  if (after == T_map_camera_.begin() || after->stamp_ns - (after - 1)->stamp_ns > kLongestGap_ns) {
    return std::nullopt;
  }
  const recording::StampedPose& before = *(after - 1);
  const double share = static_cast<double>(stamp_ns - before.stamp_ns) / static_cast<double>(after->stamp_ns - before.stamp_ns);
  return geometry::interpolate(before.T_map_camera, after->T_map_camera, share);
}

}  // namespace oikos::tracking
