// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "core/recording/trajectory.h"
#include "mapping/odometry/wheel_odometry.h"

namespace oikos::tracking {

/// Where something else believes the robot to be: a localisation's `T_map_base` over time, or one pose at the start that the wheels carry
/// on.
class PosePrior {
 public:
  /// Knows nothing.
  PosePrior() = default;
  /// `T_map_base`: ascending; interpolated between poses at most half a second apart.
  PosePrior(const recording::Trajectory& T_map_base, const Eigen::Isometry3d& T_base_camera);
  /// At the frame with this stamp.
  PosePrior(const Eigen::Isometry3d& T_map_base, std::int64_t stamp_ns, const Eigen::Isometry3d& T_base_camera);

  [[nodiscard]] std::optional<Eigen::Isometry3d> findCamera(std::int64_t stamp_ns) const;

 private:
  recording::Trajectory T_map_camera_;
};

}  // namespace oikos::tracking
