// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace oikos::mapping {

/// Which readings are good enough for surfaces (cloud, mesh, floor); occupancy takes them all.
struct DepthFilterConfig {
  double min_depth_m = 0.3;
  double max_depth_m = 4.0;      ///< a structured-light camera's noise is 2.5 cm there
  double max_step_ratio = 0.03;  ///< a reading this share nearer or farther than one beside it lies on an edge, perhaps in mid-air
  int edge_px = 2;               ///< how far away "beside" is

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("min_depth_m", min_depth_m);
    visitor("max_depth_m", max_depth_m);
    visitor("max_step_ratio", max_step_ratio);
    visitor("edge_px", edge_px);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// A copy of the depth image (CV_32FC1, metres) with NaN in place of readings that the filter refuses.
[[nodiscard]] cv::Mat filterDepth(const cv::Mat& depth_m, const DepthFilterConfig& config);

}  // namespace oikos::mapping
