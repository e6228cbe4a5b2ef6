// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/metrics/error_statistics.h"
#include "core/metrics/trajectory_association.h"

namespace oikos::metrics {

/// How far poses of a robot in `map` are from the true ones; nothing is aligned. x, y and yaw are those of `map`, as the papers give them.
struct BasePoseError {
  ErrorStatistics position_m;
  ErrorStatistics rotation_rad;
  ErrorStatistics x_m;
  ErrorStatistics y_m;
  ErrorStatistics yaw_rad;
};

/// All zero for no pairs.
[[nodiscard]] BasePoseError evaluateBasePoses(const std::vector<PosePair>& pairs);

}  // namespace oikos::metrics
