// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/gone_space.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "mapping/volume/pixel_rays.h"

namespace oikos::mapping {

GoneSpace::GoneSpace(double voxel_m, std::vector<VoxelKey> voxels) : lattice_(voxel_m), voxels_(std::move(voxels)) {
  std::sort(voxels_.begin(), voxels_.end());
}

bool GoneSpace::contains(const Eigen::Vector3d& point_map) const {
  const auto key = lattice_.findKey(point_map.cast<float>());
  return key && std::binary_search(voxels_.begin(), voxels_.end(), *key);
}

void GoneSpace::eraseFrom(cv::Mat& depth_m, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) const {
  OIKOS_CHECK(depth_m.type() == CV_32FC1 && depth_m.cols == camera.width && depth_m.rows == camera.height);
  const PixelRays rays(camera);
  for (int v = 0; v < depth_m.rows; ++v) {
    float* const row = depth_m.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; ++u) {
      if (row[u] > 0.0F && contains(T_map_camera * rays.point(u, v, row[u]).cast<double>())) {
        row[u] = std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
}

}  // namespace oikos::mapping
