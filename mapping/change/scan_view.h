// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/geometry/se3.h"
#include "mapping/change/change_config.h"

namespace oikos::mapping {

/// A depth image and where it was taken.
struct LocatedScan {
  cv::Mat depth_m;  ///< CV_32FC1, of the camera's size; NaN or 0 = no reading
  camera::PinholeCamera camera;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  /// Of (translation, rotation) on the right of T_map_camera: m², m·rad, rad²; symmetric.
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
};

/// What a scan says about a point of the map.
enum class Sight {
  kNothing,      ///< out of view, hidden, not measured, or the tolerance is too large
  kNearSurface,  ///< something stands within the tolerance along the ray
  kThrough,      ///< everything in the tolerance about the point's pixel is farther than the point by more than the tolerance, and no gap
                 ///< in the readings there could hold a thing of the voxel's size
};

struct Sighting {
  Sight sight = Sight::kNothing;
  double clear_sigmas = 0.0;  ///< kThrough: how far the nearest surface is behind the point, in standard deviations
};

/// A scan made ready for questions about points. Thread-safe.
class ScanView {
 public:
  ScanView(const LocatedScan& scan, const ChangeConfig& config, double resolution_m);

  /// Standard deviation in metres of where the map has a point of the scan: pose (largest axis), depth, map.
  [[nodiscard]] double sigma_m(const Eigen::Vector3d& point_camera) const;
  /// Farther than this from where it should be, a point is elsewhere: `sigmas` deviations and half a voxel's diagonal. Nothing: too
  /// uncertain to tell.
  [[nodiscard]] std::optional<double> findTolerance_m(const Eigen::Vector3d& point_camera) const;
  /// `tolerance_share`: of the tolerance that must be clear.
  [[nodiscard]] Sighting look(const Eigen::Vector3d& point_map, double tolerance_share) const;
  [[nodiscard]] const LocatedScan& scan() const { return scan_; }

 private:
  /// Tiles about a pixel, both ends included.
  struct Window {
    int left;
    int right;
    int top;
    int bottom;
  };
  void fillTiles();
  void sumMissing();
  /// Nothing: it reaches beyond the image.
  [[nodiscard]] std::optional<Window> findWindow(const Eigen::Vector2d& pixel, double radius_px) const;
  [[nodiscard]] float nearest_m(const Window& window) const;
  /// Whether a square of `side_px` in the window has fewer readings than the configuration asks for.
  [[nodiscard]] bool hasGap(const Window& window, int side_px) const;

  LocatedScan scan_;
  Eigen::Isometry3d T_camera_map_;
  ChangeConfig config_;
  double resolution_m_;
  int tile_columns_ = 0;
  int tile_rows_ = 0;
  std::vector<float> tiles_;  ///< nearest reading in metres
  cv::Mat missing_;           ///< CV_32SC1: pixels without a reading above and left of each corner
};

}  // namespace oikos::mapping
