// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/depth_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "core/base/config_rules.h"
#include "core/base/error.h"

namespace oikos::mapping {

namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();

/// What stays of a reading, given its four neighbours. A neighbour without a reading (NaN) says nothing. No branches: the
/// compiler makes vectors of it.
float keep(float depth, const std::array<float, 4>& neighbours, const std::array<float, 3>& limits) {
  const float step = limits[2] * depth;
  int refused = (depth >= limits[0] ? 0 : 1) | (depth <= limits[1] ? 0 : 1);
  for (const float neighbour : neighbours) {
    refused |= std::fabs(neighbour - depth) > step ? 1 : 0;
  }
  return refused != 0 ? kNoReading : depth;
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
  const std::array<float, 3> limits = {static_cast<float>(config.min_depth_m), static_cast<float>(config.max_depth_m),
                                       static_cast<float>(config.max_step_ratio)};
  const int margin = std::min({config.edge_px, depth_m.rows / 2, depth_m.cols / 2});
  cv::Mat filtered(depth_m.size(), CV_32FC1);
  for (int v = 0; v < depth_m.rows; ++v) {
    float* out = filtered.ptr<float>(v);
    const bool is_border = v < margin || v >= depth_m.rows - margin;
    if (is_border) {
      std::fill(out, out + depth_m.cols, kNoReading);
      continue;
    }
    const float* above = depth_m.ptr<float>(v - margin);
    const float* row = depth_m.ptr<float>(v);
    const float* below = depth_m.ptr<float>(v + margin);
    std::fill(out, out + margin, kNoReading);
    for (int u = margin; u < depth_m.cols - margin; ++u) {
      out[u] = keep(row[u], {above[u], below[u], row[u - margin], row[u + margin]}, limits);
    }
    std::fill(out + depth_m.cols - margin, out + depth_m.cols, kNoReading);
  }
  return filtered;
}

}  // namespace oikos::mapping
