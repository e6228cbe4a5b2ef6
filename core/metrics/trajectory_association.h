// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/enum_table.h"
#include "core/recording/trajectory.h"

namespace oikos::metrics {

enum class Association {
  kInterpolated,  ///< truth interpolated (linear, slerp) at each estimated stamp
  kNearest,       ///< nearest truth stamp, each used once, as TUM's associate.py
};
constexpr auto enumTable(Association) {
  return std::to_array<base::EnumName<Association>>({{Association::kInterpolated, "interpolated"}, {Association::kNearest, "nearest"}});
}

/// An estimated pose with the true one at the same time.
struct PosePair {
  std::int64_t stamp_ns = 0;  ///< of the estimate
  Eigen::Isometry3d T_estimate_camera = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_truth_camera = Eigen::Isometry3d::Identity();
};

/// Pairs in order of time; the inputs may be in any order. An estimate with no true stamp nearer than `max_difference_ns`, or
/// with a pose that is not finite, gets no pair; neither does one outside the truth's span of time (1 ms of it forgiven).
[[nodiscard]] std::vector<PosePair> associate(const recording::Trajectory& estimate, const recording::Trajectory& truth,
                                              Association association, std::int64_t max_difference_ns);

}  // namespace oikos::metrics
