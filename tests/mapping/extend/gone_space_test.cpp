// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/gone_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/analytic_room.h"

namespace oikos::mapping {
namespace {

constexpr double kVoxel_m = 0.05;

VoxelKey keyAt(const Eigen::Vector3d& point_map) {
  return *VoxelLattice(kVoxel_m).findKey(point_map.cast<float>());
}

TEST(GoneSpace, NothingIsInAnEmptyOne) {
  EXPECT_TRUE(GoneSpace().empty());
  EXPECT_FALSE(GoneSpace().contains({0.0, 0.0, 0.0}));
  EXPECT_TRUE(GoneSpace(kVoxel_m, {}).empty());
}

TEST(GoneSpace, HoldsItsVoxelsInWhateverOrderTheyCame) {
  const GoneSpace gone(kVoxel_m, {keyAt({1.01, 0.01, 0.01}), keyAt({-1.01, 0.01, 0.01}), keyAt({0.01, 0.01, 0.01})});
  EXPECT_TRUE(gone.contains({1.02, 0.03, 0.04}));
  EXPECT_TRUE(gone.contains({-1.02, 0.03, 0.04}));
  EXPECT_FALSE(gone.contains({1.06, 0.03, 0.04}));
  EXPECT_FALSE(gone.contains({std::nan(""), 0.0, 0.0}));
  EXPECT_FALSE(gone.contains({1e9, 0.0, 0.0}));
}

TEST(GoneSpace, ErasesTheReadingsInItAndNoOthers) {
  const camera::PinholeCamera camera = test::smallCamera();
  const Eigen::Isometry3d T_map_camera = test::lookAt({-1.0, 0.0, 1.2}, {1.0, 0.0, 0.6});
  cv::Mat depth_m = test::AnalyticRoom::furnished().render(camera, T_map_camera).depth_m;
  depth_m.at<float>(0, 0) = std::nanf("");
  const cv::Mat before = depth_m.clone();
  std::vector<VoxelKey> voxels;  // the table's front
  for (double y = -0.775; y < 0.8; y += kVoxel_m) {
    for (double z = 0.025; z < 0.7; z += kVoxel_m) {
      voxels.push_back(keyAt({0.601, y, z}));
      voxels.push_back(keyAt({0.599, y, z}));
    }
  }
  const GoneSpace gone(kVoxel_m, voxels);
  gone.eraseFrom(depth_m, camera, T_map_camera);
  int erased = 0;
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const float z = before.at<float>(v, u);
      const bool is_in = z > 0.0F && gone.contains(T_map_camera * (camera.ray(u, v) * z));
      const float now = depth_m.at<float>(v, u);
      EXPECT_TRUE(is_in ? std::isnan(now) : (now == z || (std::isnan(now) && std::isnan(z)))) << u << ' ' << v;
      erased += is_in ? 1 : 0;
    }
  }
  EXPECT_GT(erased, 500);
}

}  // namespace
}  // namespace oikos::mapping
