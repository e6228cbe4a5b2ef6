// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/scan_window.h"

#include <algorithm>
#include <cmath>

namespace oikos::registration {

PixelWindow PixelWindow::united(const PixelWindow& other) const {
  if (isEmpty() || other.isEmpty()) {
    return isEmpty() ? other : *this;
  }
  const int first_column = std::min(left, other.left);
  const int first_row = std::min(top, other.top);
  return {first_column, first_row, std::max(left + width, other.left + other.width) - first_column,
          std::max(top + height, other.top + other.height) - first_row};
}

PixelWindow windowAround(const Eigen::AlignedBox3d& box_a, const Eigen::Isometry3d& T_camera_a, const camera::PinholeCamera& camera) {
  constexpr double kNear_m = 0.05;
  if (box_a.isEmpty()) {
    return {};
  }
  Eigen::AlignedBox2d seen;
  int behind = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d point_camera = T_camera_a * box_a.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    if (point_camera.z() < kNear_m) {
      ++behind;
    } else {
      seen.extend(camera.project(point_camera));
    }
  }
  if (behind == 8) {
    return {};
  }
  if (behind > 0) {
    return {0, 0, camera.width, camera.height};
  }
  const auto bounded = [](double pixel, int size) { return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(size))); };
  const int left = bounded(std::floor(seen.min().x()) - 1.0, camera.width);
  const int top = bounded(std::floor(seen.min().y()) - 1.0, camera.height);
  return {left, top, bounded(std::ceil(seen.max().x()) + 2.0, camera.width) - left,
          bounded(std::ceil(seen.max().y()) + 2.0, camera.height) - top};
}

camera::PinholeCamera cropped(const camera::PinholeCamera& camera, const PixelWindow& window) {
  return {window.width, window.height, camera.fx, camera.fy, camera.cx - window.left, camera.cy - window.top};
}

Scan cropped(const Scan& scan, const PixelWindow& window) {
  Scan part;
  part.camera = cropped(scan.camera, window);
  part.points.reserve(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
  for (int v = window.top; v < window.top + window.height; ++v) {
    const ScanPoint* row = &scan.at(window.left, v);
    part.points.insert(part.points.end(), row, row + window.width);
  }
  return part;
}

}  // namespace oikos::registration
