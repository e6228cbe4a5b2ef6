// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace oikos::camera {

/// What a perfect camera would see: images of one size, from one pinhole, at one instant.
struct IdealView {
  cv::Mat depth_m;        ///< CV_32FC1, metres along the optical axis; NaN = nothing hit
  cv::Mat normal_camera;  ///< CV_32FC3, unit, facing the camera
  cv::Mat reflectivity;   ///< CV_32FC1, 0 to 1: how bright the surface is in infrared
  cv::Mat gloss;          ///< CV_32FC1, 0 matt … 1 mirror or clear glass
};

/// Which noise a frame gets: the same seed and frame give the same bytes, whatever the number of threads.
struct SensorRun {
  std::uint64_t seed = 0;
  std::int64_t frame = 0;
  int threads = 1;
};

}  // namespace oikos::camera
