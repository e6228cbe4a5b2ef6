// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera/calibration.h"
#include "core/camera/rectifier.h"

namespace oikos::camera {

/// Turns a stored depth image into metres in the rectified colour camera, pixel by pixel. Immutable, so thread-safe.
///
/// Depth that is registered already follows the colour image through its rectification by nearest neighbour (nothing is mixed
/// over an edge). Depth of a camera of its own is lifted along precomputed rays, moved by T_color_depth and splatted: each reading
/// covers the colour pixels that its own pixel covers on a surface facing the camera, and the nearest reading wins, so that what lies
/// behind does not show through what stands in front, whichever of the two images is the larger.
class DepthRegistration {
 public:
  /// `rectifier` is the colour camera's.
  DepthRegistration(const Calibration& calibration, const Rectifier& rectifier);

  /// Size of the stored depth images.
  [[nodiscard]] int storedWidth() const { return stored_.width; }
  [[nodiscard]] int storedHeight() const { return stored_.height; }

  /// `stored`: CV_16UC1 of the stored size, 0 and 65535 = no reading. Result: CV_32FC1 of the colour camera's size, NaN = no reading.
  [[nodiscard]] cv::Mat toMetres(const cv::Mat& stored) const;

 private:
  struct ProjectedRow;

  [[nodiscard]] cv::Mat convert(const cv::Mat& stored) const;
  [[nodiscard]] cv::Mat splat(const cv::Mat& stored) const;
  void project(const cv::Mat& stored, int v, ProjectedRow& row) const;
  void prepareSplatting(const DepthCamera& depth);
  void prepareCorrection(const DepthCamera& depth);

  PinholeCamera color_;
  PinholeCamera stored_;
  float unit_m_ = 0.001F;                   ///< metres per stored unit
  std::vector<std::int32_t> source_index_;  ///< registered depth of a lens with distortion; else empty
  bool is_separate_ = false;
  // Of a separate depth camera: the homogeneous colour pixel of a reading d (metres) is ray * d + offset.
  std::vector<float> ray_u_;
  std::vector<float> ray_v_;
  std::vector<float> ray_z_;
  Eigen::Vector3f offset_ = Eigen::Vector3f::Zero();
  std::vector<float> factor_;  ///< a reading z is really z * (factor + factor_per_m * z); empty: it is what it says
  float factor_per_m_ = 0.0F;
  cv::Size2f half_splat_px_;      ///< of a surface at the same distance from both cameras
  bool is_single_pixel_ = false;  ///< no splat is larger than a colour pixel
};

}  // namespace oikos::camera
