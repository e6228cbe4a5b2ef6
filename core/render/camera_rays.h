// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/camera/calibration.h"

namespace oikos::render {

/// What a lens sees: the ray of each pixel of the image as the camera stores it, lens distortion included. Immutable, so thread-safe.
class CameraRays {
 public:
  /// Throws Error{kInput} if the distortion cannot be inverted within the image.
  explicit CameraRays(const camera::PinholeCamera& camera, const camera::LensDistortion& distortion = {});

  [[nodiscard]] int width() const { return camera_.width; }
  [[nodiscard]] int height() const { return camera_.height; }
  /// What a pixel covers at 1 m (m).
  [[nodiscard]] double pixelSize() const { return 1.0 / camera_.fx; }

  /// The point at z = 1 m (camera frame) that falls on a pixel's centre, moved by a part of a pixel: `offset_px` in [-0.5, 0.5].
  [[nodiscard]] Eigen::Vector2d at(int u_px, int v_px, const Eigen::Vector2d& offset_px = Eigen::Vector2d::Zero()) const {
    if (rays_.empty()) {
      return {(u_px + offset_px.x() - camera_.cx) * per_fx_, (v_px + offset_px.y() - camera_.cy) * per_fy_};
    }
    return stored(u_px, v_px) + 0.5 * (offset_px.x() * (stored(u_px + 1, v_px) - stored(u_px - 1, v_px)) +
                                       offset_px.y() * (stored(u_px, v_px + 1) - stored(u_px, v_px - 1)));
  }

 private:
  [[nodiscard]] const Eigen::Vector2d& stored(int u_px, int v_px) const {
    return rays_[static_cast<std::size_t>(v_px + 1) * static_cast<std::size_t>(camera_.width + 2) + static_cast<std::size_t>(u_px + 1)];
  }

  camera::PinholeCamera camera_;
  double per_fx_;
  double per_fy_;
  std::vector<Eigen::Vector2d> rays_;  ///< with a margin of one pixel; empty without distortion
};

}  // namespace oikos::render
