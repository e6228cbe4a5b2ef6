// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace oikos::camera {

/// Standard deviation of one depth reading of a structured-light camera: a constant part plus disparity quantisation and
/// noise that grow with the square of the distance (Khoshelham & Elberink, Sensors 2012, eq. 12: 1.425e-3 / m at z^2, used by
/// most RGB-D SLAM). `depth_m` > 0.
[[nodiscard]] constexpr double depthSigma_m(double depth_m) {
  return 0.0015 + 0.001425 * depth_m * depth_m;
}

/// The same as inverse depth (1/m): sigma_z / z^2.
[[nodiscard]] constexpr double inverseDepthSigma(double depth_m) {
  return depthSigma_m(depth_m) / (depth_m * depth_m);
}

}  // namespace oikos::camera
