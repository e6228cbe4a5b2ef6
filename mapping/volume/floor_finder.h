// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/geometry/plane_fit.h"
#include "mapping/volume/brick_index.h"
#include "mapping/volume/voxel_ray.h"

namespace oikos::mapping {

struct FloorConfig {
  double voxel_m = 0.05;             ///< readings are averaged to one surface element a voxel
  int pixel_stride = 4;              ///< every n-th pixel of every n-th row
  double normal_baseline_m = 0.12;   ///< normals are taken over about this length
  double max_tilt_rad = 0.96;        ///< between up and the mean image-up; 55°
  double inlier_distance_m = 0.03;   ///< of a plane; grows by half where a second look is taken
  double min_area_m2 = 0.4;          ///< a smaller plane is no floor
  double min_camera_height_m = 0.2;  ///< no camera of a robot, or of one who maps by hand, is nearer to the floor
  double max_share_below = 0.1;      ///< surface seen well below a floor, over the floor's own
  std::int64_t seed = 1;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("voxel_m", voxel_m);
    visitor("pixel_stride", pixel_stride);
    visitor("normal_baseline_m", normal_baseline_m);
    visitor("max_tilt_rad", max_tilt_rad);
    visitor("inlier_distance_m", inlier_distance_m);
    visitor("min_area_m2", min_area_m2);
    visitor("min_camera_height_m", min_camera_height_m);
    visitor("max_share_below", max_share_below);
    visitor("seed", seed);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class FloorStatus {
  kNoFrames,  ///< nothing was added
  kNoFloor,   ///< no plane that could be the floor is in sight: up is a guess, z = 0 is at the first camera
  kFound,
};

struct [[nodiscard]] FloorResult {
  FloorStatus status = FloorStatus::kNoFrames;
  /// z up, floor at z = 0, the origin below the first camera (without a floor: in it), x along its optical axis.
  Eigen::Isometry3d T_map_world = Eigen::Isometry3d::Identity();
  int inliers = 0;               ///< surface elements of the floor
  double area_m2 = 0.0;          ///< of floor seen
  double rms_m = 0.0;            ///< distances of the inliers
  double tilt_rad = 0.0;         ///< between up and the mean image-up
  double agreement = 0.0;        ///< surface that lies along or across up (within 10°) / all surface
  double camera_height_m = 0.0;  ///< of the first camera above the floor
};

/// Finds which way is up and where the floor is from posed depth images. Up: the direction near image-up that most surface lies
/// along or across (the floor, tables and walls vote alike, so a floor that is seen little does not tip). Floor: among the
/// planes that face up (RANSAC, then least squares), the lowest of some size with next to nothing below it. Memory grows with
/// the surface seen. Not thread-safe; the same calls give the same bits.
class FloorFinder {
 public:
  explicit FloorFinder(const FloorConfig& config);

  /// `depth_m`: CV_32FC1, metres, NaN = no reading; best after `filterDepth`.
  void add(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_world_camera);

  FloorResult find() const;

 private:
  struct Sum {
    Eigen::Vector3f point_world = Eigen::Vector3f::Zero();  ///< from the voxel's centre
    Eigen::Vector3f normal_world = Eigen::Vector3f::Zero();
    int count = 0;
  };

  FloorConfig config_;
  VoxelLattice lattice_;
  BrickIndex index_;
  std::vector<Sum> sums_;
  std::optional<Eigen::Isometry3d> T_world_first_;
  Eigen::Vector3d image_up_sum_ = Eigen::Vector3d::Zero();
};

}  // namespace oikos::mapping
