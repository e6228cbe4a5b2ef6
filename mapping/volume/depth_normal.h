// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/camera/pinhole_camera.h"

namespace oikos::mapping {

/// Normal at a pixel from the four readings `reach_px` beside it, which are within the image: frame camera, unit length, towards the
/// camera; nothing at edges and holes. `depth_m`: CV_32FC1.
[[nodiscard]] std::optional<Eigen::Vector3f> findDepthNormal(const cv::Mat& depth_m, const camera::PinholeCamera& camera,
                                                             const Eigen::Vector2i& pixel, int reach_px);

}  // namespace oikos::mapping
