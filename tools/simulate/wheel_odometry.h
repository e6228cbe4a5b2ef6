// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/recording/trajectory.h"
#include "tools/simulate/scene_script.h"

namespace oikos::simulate {

/// What the wheels say: `T_odom_base` from the first pose on, drifting with the way and the turns as one set of wheels does, plus a little
/// slip at each step.
[[nodiscard]] recording::Trajectory makeWheelOdometry(const recording::Trajectory& T_map_base, const OdometrySettings& settings,
                                                      std::uint64_t seed);

/// What a particle filter on a laser scan says (AMCL; Fox 2003): the pose with an error that wanders slowly within its deviation.
[[nodiscard]] recording::Trajectory makePrior(const recording::Trajectory& T_map_base, const OdometrySettings& settings,
                                              std::uint64_t seed);

}  // namespace oikos::simulate
