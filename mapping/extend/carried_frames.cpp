// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/carried_frames.h"

#include <algorithm>
#include <cstddef>

#include "core/base/error.h"
#include "core/geometry/se3.h"

namespace oikos::mapping {

namespace {

Eigen::Isometry3d movedWith(const MovedKeyframe& keyframe, const Eigen::Isometry3d& T_map_frame) {
  return keyframe.T_map_after * (keyframe.T_map_before.inverse() * T_map_frame);
}

/// How far on the way from one stamp to the next; the stamps of two drives may stand in any order.
double shareOf(std::int64_t stamp_ns, std::int64_t before_ns, std::int64_t after_ns) {
  if (after_ns <= before_ns) {
    return 0.0;
  }
  return std::clamp(static_cast<double>(stamp_ns - before_ns) / static_cast<double>(after_ns - before_ns), 0.0, 1.0);
}

}  // namespace

recording::Trajectory carryAlong(const recording::Trajectory& trajectory, const std::vector<MovedKeyframe>& keyframes) {
  OIKOS_CHECK(!keyframes.empty());
  recording::Trajectory moved = trajectory;
  std::size_t after = 0;  // the first keyframe at the frame or behind it
  for (std::size_t i = 0; i < moved.size(); ++i) {
    while (after < keyframes.size() && keyframes[after].frame < static_cast<int>(i)) {
      ++after;
    }
    Eigen::Isometry3d& T_map_frame = moved[i].T_map_camera;
    if (after == 0 || after == keyframes.size()) {
      T_map_frame = movedWith(keyframes[after == 0 ? 0 : after - 1], T_map_frame);
      continue;
    }
    const MovedKeyframe& a = keyframes[after - 1];
    const MovedKeyframe& b = keyframes[after];
    const double share = shareOf(moved[i].stamp_ns, trajectory[static_cast<std::size_t>(a.frame)].stamp_ns,
                                 trajectory[static_cast<std::size_t>(b.frame)].stamp_ns);
    T_map_frame = geometry::interpolate(movedWith(a, T_map_frame), movedWith(b, T_map_frame), share);
  }
  return moved;
}

}  // namespace oikos::mapping
