// SPDX-License-Identifier: Apache-2.0
// What a depth camera measured, thinned and ready to be registered.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"

namespace cv {
class Mat;
}

namespace oikos::registration {

struct ScanConfig {
  int step_px = 4;               ///< one point in so many columns and rows
  int normal_radius_px = 6;      ///< half the window that a normal is fitted to
  double max_step_share = 0.03;  ///< neighbours whose depth differs by more than this share belong to another surface
  double min_range_m = 0.3;
  double max_range_m = 4.5;  ///< farther readings are too noisy to move anything

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("step_px", step_px);
    visitor("normal_radius_px", normal_radius_px);
    visitor("max_step_share", max_step_share);
    visitor("min_range_m", min_range_m);
    visitor("max_range_m", max_range_m);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct ScanPoint {
  Eigen::Vector3f point_camera = Eigen::Vector3f::Zero();   ///< z = 0: no reading
  Eigen::Vector3f normal_camera = Eigen::Vector3f::Zero();  ///< towards the camera, length 1; 0: none could be fitted
};

/// Points in the rows and columns of a thinned image: the pixels of `camera`, which is the real one seen through a coarser grid.
struct Scan {
  camera::PinholeCamera camera;
  std::vector<ScanPoint> points;  ///< row by row, camera.width * camera.height

  [[nodiscard]] const ScanPoint& at(int u_px, int v_px) const {
    return points[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(u_px)];
  }
};

/// Columns from `left` to before `right`, rows from `top` to before `bottom`.
struct PixelBox {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  [[nodiscard]] bool contains(const PixelBox& other) const {
    return left <= other.left && top <= other.top && right >= other.right && bottom >= other.bottom;
  }
};

/// The pinhole whose pixel (u, v) is the pixel (u, v) * step of `camera`.
[[nodiscard]] camera::PinholeCamera thinned(const camera::PinholeCamera& camera, int step_px);

/// `depth_m`: CV_32FC1 of the camera's size, NaN = no reading. A normal comes from the inverse depth around a point, which on a plane is
/// linear in the image: q(u, v) = (n · ray(u, v)) / d.
[[nodiscard]] Scan makeScan(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const ScanConfig& config);

/// Every `factor`-th point of a scan.
[[nodiscard]] Scan thinned(const Scan& scan, int factor);

/// The pixels of a box that lies in the scan, as a camera of their own.
[[nodiscard]] Scan cropped(const Scan& scan, const PixelBox& box);

}  // namespace oikos::registration
