// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/camera/pinhole_camera.h"

namespace oikos::camera {

/// Radial and tangential lens distortion (Brown 1966, "Decentering Distortion of Lenses"; coefficients in OpenCV's order).
struct LensDistortion {
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  [[nodiscard]] bool isZero() const { return k1 == 0.0 && k2 == 0.0 && p1 == 0.0 && p2 == 0.0 && k3 == 0.0; }
  /// Where a point of the undistorted image plane (z = 1) appears on the distorted one.
  [[nodiscard]] Eigen::Vector2d distort(const Eigen::Vector2d& undistorted) const;
};

/// What the distances of a depth camera are wrong by: a reading of z metres at the image plane's point (x, y, 1) is multiplied by
/// 1 + constant + per_m * z + across * x + down * y. (A plane for the multiplier image of Teichman, Miller & Thrun, "Unsupervised intrinsic
/// calibration of depth sensors via SLAM", RSS 2013.)
struct DepthCorrection {
  double constant = 0.0;
  double per_m = 0.0;
  double across = 0.0;
  double down = 0.0;

  [[nodiscard]] bool isZero() const { return constant == 0.0 && per_m == 0.0 && across == 0.0 && down == 0.0; }
};

/// A depth camera that is not the colour camera; it has no lens distortion.
struct DepthCamera {
  PinholeCamera pinhole;
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
  DepthCorrection correction;
};

/// What `camera.toml` says about the camera of a recording.
struct Calibration {
  PinholeCamera color;                   ///< also the camera of the rectified frames
  LensDistortion distortion;             ///< of the colour images as they are stored
  double depth_scale = 1000.0;           ///< depth units per metre
  double depth_distortion = 0.003;       ///< of a distance, what varies smoothly over the picture and is not corrected: a deviation
  std::optional<DepthCamera> depth;      ///< absent: depth is registered to colour, pixel by pixel, distortion included
  std::optional<std::int64_t> start_ns;  ///< UTC of stamp 0, nanoseconds since 1970
  double rate_hz = 30.0;                 ///< of recordings that number their frames instead of stamping them
  std::optional<Eigen::Isometry3d> T_base_camera;  ///< the mount on the robot
};

/// Throws Error{kInput} with the file, the line or key, the value found and what would be right; Error{kIo} if there is no such file.
[[nodiscard]] Calibration readCalibration(const std::filesystem::path& file);

/// Published calibrations by name: kinect1, tum-fr1, tum-fr2, tum-fr3, icl-nuim.
[[nodiscard]] std::optional<Calibration> findCalibrationPreset(std::string_view name);
[[nodiscard]] const std::vector<std::string>& calibrationPresetNames();

/// A preset's name or the path of a camera.toml. Throws Error{kUsage} if it is neither.
[[nodiscard]] Calibration getCalibration(const std::string& preset_or_file);

}  // namespace oikos::camera
