// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/depth_filter.h"

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "core/base/config_rules.h"
#include "core/base/error.h"

namespace oikos::mapping {

namespace {

/// False for a neighbour without a reading: that says nothing.
bool isStep(float depth, float neighbour, float ratio) {
  return std::fabs(neighbour - depth) > ratio * depth;
}

}  // namespace

std::vector<std::string> DepthFilterConfig::validate() const {
  base::ConfigRules rules;
  rules.atLeast("min_depth_m", min_depth_m, 0.0).greater("max_depth_m", max_depth_m, min_depth_m);
  rules.greater("max_step_ratio", max_step_ratio, 0.0).between("edge_px", edge_px, 1, 16);
  return rules.messages();
}

cv::Mat filterDepth(const cv::Mat& depth_m, const DepthFilterConfig& config) {
  OIKOS_CHECK(depth_m.type() == CV_32FC1);
  cv::Mat filtered(depth_m.size(), CV_32FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  const auto nearest = static_cast<float>(config.min_depth_m);
  const auto farthest = static_cast<float>(config.max_depth_m);
  const auto ratio = static_cast<float>(config.max_step_ratio);
  const int margin = config.edge_px;
  for (int v = margin; v < depth_m.rows - margin; ++v) {
    const float* above = depth_m.ptr<float>(v - margin);
    const float* row = depth_m.ptr<float>(v);
    const float* below = depth_m.ptr<float>(v + margin);
    float* out = filtered.ptr<float>(v);
    for (int u = margin; u < depth_m.cols - margin; ++u) {
      const float depth = row[u];
      const bool is_edge = isStep(depth, above[u], ratio) || isStep(depth, below[u], ratio) || isStep(depth, row[u - margin], ratio) ||
                           isStep(depth, row[u + margin], ratio);
      if (depth >= nearest && depth <= farthest && !is_edge) {
        out[u] = depth;
      }
    }
  }
  return filtered;
}

}  // namespace oikos::mapping
