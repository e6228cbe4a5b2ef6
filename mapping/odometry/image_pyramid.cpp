// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/image_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"

namespace oikos::mapping {

ImagePyramid::ImagePyramid(const cv::Mat& gray, int max_levels) {
  OIKOS_CHECK(gray.type() == CV_8UC1 && !gray.empty() && max_levels >= 1);
  images_.push_back(gray);
  while (levels() < max_levels && std::min(images_.back().cols, images_.back().rows) >= 48) {
    cv::Mat half;
    const cv::Size size(images_.back().cols / 2, images_.back().rows / 2);
    // INTER_AREA by exactly two averages 2 x 2 pixels: the pixel grids then relate as the class comment says. An odd column or row
    // is left out: shrinking over it would stretch the grid.
    const cv::Mat even = images_.back()(cv::Rect(0, 0, 2 * size.width, 2 * size.height));
    cv::resize(even, half, size, 0.0, 0.0, cv::INTER_AREA);
    images_.push_back(half);
  }
}

}  // namespace oikos::mapping
