// SPDX-License-Identifier: Apache-2.0
// The part of an image that something can be seen in.
#pragma once

#include <Eigen/Geometry>

#include "core/camera/pinhole_camera.h"
#include "registration/scan.h"

namespace oikos::registration {

/// A rectangle of pixels.
struct PixelWindow {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;

  [[nodiscard]] bool isEmpty() const { return width <= 0 || height <= 0; }
  /// The smallest window around both; an empty one adds nothing.
  [[nodiscard]] PixelWindow united(const PixelWindow& other) const;
};

/// Where a box is seen, with a margin of one pixel, within the image; the whole image if the camera's plane goes through it, and empty if
/// it lies behind the camera or beside the image. `box`: in any frame a.
[[nodiscard]] PixelWindow windowAround(const Eigen::AlignedBox3d& box_a, const Eigen::Isometry3d& T_camera_a,
                                       const camera::PinholeCamera& camera);

/// The pinhole of the window's pixels.
[[nodiscard]] camera::PinholeCamera cropped(const camera::PinholeCamera& camera, const PixelWindow& window);
[[nodiscard]] Scan cropped(const Scan& scan, const PixelWindow& window);

}  // namespace oikos::registration
