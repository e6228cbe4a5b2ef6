// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/camera/pinhole_camera.h"

namespace oikos::registration {

/// A depth image and where it was taken.
struct DepthView {
  cv::Mat depth_m;  ///< CV_32FC1 of the camera's size, NaN = no reading
  camera::PinholeCamera camera;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// Deviation of a reading along z: Nguyen, Izadi & Lovell 2012 (doi:10.1109/3DIMPVT.2012.84), a structured-light sensor.
[[nodiscard]] inline double readingSigma_m(double z_m) {
  const double from_nearest = z_m - 0.4;
  return 0.0012 + 0.0019 * from_nearest * from_nearest;
}

}  // namespace oikos::registration
