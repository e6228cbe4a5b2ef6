// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

namespace oikos::camera {

/// Pinhole intrinsics in pixels; pixel centres are at integer coordinates. Camera frame: z forward, x right, y down.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;

  /// Pixel of a point in the camera frame; z must be > 0.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point_camera) const {
    return {fx * point_camera.x() / point_camera.z() + cx, fy * point_camera.y() / point_camera.z() + cy};
  }
  /// Point on the pixel's ray at z = 1 m.
  [[nodiscard]] Eigen::Vector3d ray(double u_px, double v_px) const { return {(u_px - cx) / fx, (v_px - cy) / fy, 1.0}; }

  [[nodiscard]] bool contains(const Eigen::Vector2d& pixel, double margin_px = 0.0) const {
    return pixel.x() >= margin_px && pixel.y() >= margin_px && pixel.x() <= width - 1 - margin_px && pixel.y() <= height - 1 - margin_px;
  }
};

}  // namespace oikos::camera
