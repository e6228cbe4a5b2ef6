// SPDX-License-Identifier: Apache-2.0
// What a camera sees in truth of small objects.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "tools/simulate/world.h"

namespace oikos::bench {

/// Pixels of an image in which an object would be seen.
using Pixels = std::vector<cv::Point>;

/// What is in view in an image of test::kinectCamera(): half of it or more, 150 pixels or more, the whole of it in the picture. By id.
[[nodiscard]] std::map<std::string, Pixels> seenIn(const simulate::World& world, const Eigen::Isometry3d& T_map_camera);

/// Whether half of these pixels or more have a reading.
[[nodiscard]] bool isMeasured(const Pixels& pixels, const cv::Mat& depth_m);

}  // namespace oikos::bench
