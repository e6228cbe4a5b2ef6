// SPDX-License-Identifier: Apache-2.0
#include "registration/scan.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "registration/scan_normals.h"

namespace oikos::registration {

std::vector<std::string> ScanConfig::validate() const {
  return base::ConfigRules()
      .atLeast("step_px", step_px, 1)
      .atLeast("normal_radius_px", normal_radius_px, 2)
      .greater("max_step_share", max_step_share, 0.0)
      .atLeast("min_range_m", min_range_m, 0.0)
      .greater("max_range_m", max_range_m, min_range_m)
      .messages();
}

camera::PinholeCamera thinned(const camera::PinholeCamera& camera, int step_px) {
  return {(camera.width + step_px - 1) / step_px,
          (camera.height + step_px - 1) / step_px,
          camera.fx / step_px,
          camera.fy / step_px,
          camera.cx / step_px,
          camera.cy / step_px};
}

Scan makeScan(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const ScanConfig& config) {
  OIKOS_CHECK(depth_m.type() == CV_32FC1 && depth_m.cols == camera.width && depth_m.rows == camera.height);
  Scan scan;
  scan.camera = thinned(camera, config.step_px);
  scan.points.resize(static_cast<std::size_t>(scan.camera.width) * static_cast<std::size_t>(scan.camera.height));
  RowNormals normals(depth_m, camera, config);
  auto point = scan.points.begin();
  for (int v = 0; v < camera.height; v += config.step_px) {
    normals.fit(v);
    for (int column = 0; column < scan.camera.width; ++column, ++point) {
      const int u = column * config.step_px;
      const double z = static_cast<double>(depth_m.at<float>(v, u));
      if (z >= config.min_range_m && z <= config.max_range_m) {
        point->point_camera = (z * camera.ray(u, v)).cast<float>();
        point->normal_camera = normals.at(static_cast<std::size_t>(column));
      }
    }
  }
  return scan;
}

Scan thinned(const Scan& scan, int factor) {
  Scan coarse;
  coarse.camera = thinned(scan.camera, factor);
  for (int v = 0; v < scan.camera.height; v += factor) {
    for (int u = 0; u < scan.camera.width; u += factor) {
      coarse.points.push_back(scan.at(u, v));
    }
  }
  return coarse;
}

Scan cropped(const Scan& scan, const PixelBox& box) {
  OIKOS_CHECK(box.left >= 0 && box.top >= 0 && box.right <= scan.camera.width && box.bottom <= scan.camera.height);
  Scan part;
  part.camera = scan.camera;
  part.camera.width = std::max(0, box.right - box.left);
  part.camera.height = std::max(0, box.bottom - box.top);
  part.camera.cx -= box.left;
  part.camera.cy -= box.top;
  part.points.reserve(static_cast<std::size_t>(part.camera.width) * static_cast<std::size_t>(part.camera.height));
  for (int v = box.top; v < box.bottom; ++v) {
    const ScanPoint* const row = &scan.at(0, v);
    part.points.insert(part.points.end(), row + box.left, row + std::max(box.left, box.right));
  }
  return part;
}

}  // namespace oikos::registration
