// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/depth_scan.h"

#include <opencv2/core.hpp>

#include "core/base/error.h"

namespace oikos::mapping {

OccupancyScan makeScan(const PosedFrame& posed, const OccupancyConfig& config) {
  const cv::Mat& depth = posed.frame.depth_m;
  OIKOS_CHECK(depth.type() == CV_32FC1 && depth.cols == posed.camera.width && depth.rows == posed.camera.height);
  const Eigen::Isometry3f T_map_camera = posed.T_map_camera.cast<float>();
  OccupancyScan scan;
  scan.origin_map = T_map_camera.translation();
  const auto min_range_sq = static_cast<float>(config.min_range_m * config.min_range_m);
  for (int v = 0; v < depth.rows; v += config.pixel_stride) {
    const float* row = depth.ptr<float>(v);
    for (int u = 0; u < depth.cols; u += config.pixel_stride) {
      if (row[u] > 0.0F) {
        const Eigen::Vector3f point_camera = row[u] * posed.camera.ray(u, v).cast<float>();
        if (point_camera.squaredNorm() >= min_range_sq) {
          scan.points_map.push_back(T_map_camera * point_camera);
        }
      }
    }
  }
  return scan;
}

}  // namespace oikos::mapping
