// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/volume/voxel_ray.h"

namespace oikos::mapping {

/// Where a later drive has seen that things which are in a map are no longer there. Reading is thread-safe.
class GoneSpace {
 public:
  GoneSpace() = default;
  GoneSpace(double voxel_m, std::vector<VoxelKey> voxels);

  [[nodiscard]] bool empty() const { return voxels_.empty(); }
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_map) const;
  /// Makes the readings in there NaN: neither is a surface there any more, nor do their rays say anything.
  void eraseFrom(cv::Mat& depth_m, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) const;

 private:
  VoxelLattice lattice_{1.0};
  std::vector<VoxelKey> voxels_;  ///< ascending
};

}  // namespace oikos::mapping
