// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/camera/pinhole_camera.h"

namespace oikos::mapping {

/// The rays of a camera's pixels at z = 1 m, divided once instead of at every pixel.
class PixelRays {
 public:
  explicit PixelRays(const camera::PinholeCamera& camera) {
    for (int u = 0; u < camera.width; ++u) {
      x_.push_back(static_cast<float>(camera.ray(u, 0.0).x()));
    }
    for (int v = 0; v < camera.height; ++v) {
      y_.push_back(static_cast<float>(camera.ray(0.0, v).y()));
    }
  }

  [[nodiscard]] Eigen::Vector3f point(int u, int v, float depth_m) const {
    return {depth_m * x_[static_cast<std::size_t>(u)], depth_m * y_[static_cast<std::size_t>(v)], depth_m};
  }

 private:
  std::vector<float> x_;
  std::vector<float> y_;
};

}  // namespace oikos::mapping
