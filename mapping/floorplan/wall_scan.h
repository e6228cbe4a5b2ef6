// SPDX-License-Identifier: Apache-2.0
// The walls of a map from above: what stands upright, and where floor was seen (S58).
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/volume/brick_index.h"

namespace oikos::mapping {

/// Frame `level`: z up, floor at z = 0, placed and turned anyhow.
struct WallPoint {
  Eigen::Vector2d point_level = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal_level = Eigen::Vector2d::UnitX();  ///< unit length, towards the room
};

struct WallSketch {
  std::vector<WallPoint> walls;              ///< one or more for every cell that has upright surface
  std::vector<Eigen::Vector2d> floor_level;  ///< centres of the cells where floor was seen
  double cell_m = 0.05;

  /// How much of wall was seen, at most: noise and furniture's edges spread a surface over neighbouring cells.
  [[nodiscard]] double wallLengthM() const { return static_cast<double>(walls.size()) * cell_m; }
};

struct WallScanConfig {
  double cell_m = 0.05;
  int pixel_stride = 4;             ///< every n-th pixel of every n-th row
  double normal_baseline_m = 0.12;  ///< normals are taken over about this length
  double max_range_m = 4.5;         ///< readings farther off are left out
  double min_height_m = 0.3;        ///< of wall over the floor
  double max_height_m = 2.2;
  int min_height_bins = 3;     ///< of 20 cm each, that a cell's upright surface fills: less is no wall
  double floor_band_m = 0.06;  ///< level surface so near to z = 0 is floor
  int max_views = 300;         ///< spread over the drive

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("cell_m", cell_m);
    visitor("pixel_stride", pixel_stride);
    visitor("normal_baseline_m", normal_baseline_m);
    visitor("max_range_m", max_range_m);
    visitor("min_height_m", min_height_m);
    visitor("max_height_m", max_height_m);
    visitor("min_height_bins", min_height_bins);
    visitor("floor_band_m", floor_band_m);
    visitor("max_views", max_views);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Gathers depth images into a sketch of the walls. Readings are weighed as a structured-light camera's are good: by distance to the
/// power of minus four. Not thread-safe; the order of the images matters only to the last bits.
class WallScan {
 public:
  explicit WallScan(const WallScanConfig& config);

  /// `depth_m`: CV_32FC1 of the camera's size; NaN: no reading.
  void add(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_level_camera);
  [[nodiscard]] WallSketch sketch() const;

 private:
  struct Sum {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< from the cell's corner, weighed
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();
    double weight = 0.0;
    int count = 0;
    unsigned heights = 0;  ///< one bit a bin
  };
  void addWall(const Eigen::Vector3d& point_level, const Eigen::Vector3d& normal_level, double weight);
  void addFloor(const Eigen::Vector3d& point_level);

  WallScanConfig config_;
  BrickIndex wall_index_;
  std::vector<Sum> walls_;
  BrickIndex floor_index_;
  std::vector<int> floor_counts_;
};

}  // namespace oikos::mapping
