// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/geometry/se3.h"

namespace oikos::camera {

/// How the camera moves while an image is taken. `mid` is the camera at the instant of which the ideal view was rendered.
struct ShutterMotion {
  std::vector<Eigen::Isometry3d> T_mid_row;  ///< the camera in the middle of each row's exposure; empty: all rows at `mid`
  /// Per second, (translation, rotation) in the camera's frame: within t seconds the camera moves by expSe3(twist_camera * t).
  geometry::Vector6d twist_camera = geometry::Vector6d::Zero();

  [[nodiscard]] bool isStill() const { return T_mid_row.empty() && twist_camera.isZero(0.0); }
};

/// Steady motion under a rolling shutter that takes `readout_s` from the first to the last of `rows`; 0: a global shutter.
[[nodiscard]] ShutterMotion makeSteadyMotion(const geometry::Vector6d& twist_camera, double readout_s, int rows);

/// Samples an ideal image as the moving camera's rows see it, by following each pixel's flow during the exposure; the depth at the same
/// pixel of the ideal view stands for the depth of what is seen. What the ideal view hides stays hidden: near edges of depth a pixel or two
/// of the flow's length are guessed. Immutable, so thread-safe.
class ShutterWarp {
 public:
  struct Settings {
    double exposure_s = 0.0;
    int max_samples = 8;  ///< along a pixel's flow; a shorter flow takes one each 1.5 px, two at least
  };
  ShutterWarp(const PinholeCamera& camera, const ShutterMotion& motion, const Settings& settings);

  /// Writes the mean light of row v, four floats a pixel. `light`: CV_32FC4; `depth_m`: CV_32FC1, NaN = far away.
  void fillRow(const cv::Mat& light, const cv::Mat& depth_m, int v, float* row) const;

 private:
  /// The homogeneous pixel of the ideal image for pixel u at inverse depth w is u * per_column + start + w * per_inverse_depth.
  struct RowProjection {
    RowProjection(const PinholeCamera& camera, const Eigen::Isometry3d& T_mid_camera, int v);
    /// For the pixels of a row.
    void fill(const float* depths_m, int width, float* pixels_u, float* pixels_v) const;
    Eigen::Vector3f per_column, start, per_inverse_depth;
  };

  PinholeCamera camera_;
  ShutterMotion motion_;
  Eigen::Isometry3d T_middle_begin_;  ///< of a row's exposure
  Eigen::Isometry3d T_middle_end_;
  int max_samples_;
};

}  // namespace oikos::camera
