// SPDX-License-Identifier: Apache-2.0
// What a camera sees in truth of small objects.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/depth_sensor.h"
#include "tools/simulate/world.h"

namespace oikos::bench {

[[nodiscard]] camera::PinholeCamera missedCamera();

/// Pixels of an image in which an object would be seen.
using Pixels = std::vector<cv::Point>;

/// What is in view in an image: half of it or more, 150 pixels or more, the whole of it in the picture. By id.
[[nodiscard]] std::map<std::string, Pixels> seenIn(const simulate::World& world, const Eigen::Isometry3d& T_map_camera);

/// Whether half of these pixels or more have a reading.
[[nodiscard]] bool isMeasured(const Pixels& pixels, const cv::Mat& depth_m);

/// CV_32FC1, m; NaN: no reading.
[[nodiscard]] cv::Mat senseDepth(const simulate::World& world, const Eigen::Isometry3d& T_map_camera, camera::DepthSensorKind kind,
                                 std::uint64_t seed);

}  // namespace oikos::bench
