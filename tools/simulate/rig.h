// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/camera/calibration.h"
#include "tools/simulate/scene_script.h"

namespace oikos::simulate {

/// The camera as its maker delivers it: what the recording's camera.toml says. Of a depth camera of its own the colour camera's focal
/// length and size set those of a Kinect 1; a Kinect 2 has 512x424 pixels.
[[nodiscard]] camera::Calibration nominalCalibration(const SceneScript& script);

/// The one that the pictures are taken with.
[[nodiscard]] camera::Calibration trueCalibration(const camera::Calibration& nominal, const BeliefSettings& belief, std::uint64_t seed);

/// A camera.toml that readCalibration reads as `calibration`; `start` is the recording's, RFC 3339.
[[nodiscard]] std::string toToml(const camera::Calibration& calibration, const std::string& start);

}  // namespace oikos::simulate
