// SPDX-License-Identifier: Apache-2.0
#include "registration/scan.h"

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/config_rules.h"
#include "core/base/error.h"

namespace oikos::registration {

namespace {

/// Least squares of q = a * du + b * dv + c over readings near a pixel.
class InversePlane {
 public:
  void add(double du, double dv, double q) {
    uu_ += du * du;
    uv_ += du * dv;
    vv_ += dv * dv;
    u_ += du;
    v_ += dv;
    qu_ += q * du;
    qv_ += q * dv;
    q_ += q;
    ++count_;
  }
  [[nodiscard]] int count() const { return count_; }
  /// (a, b, c); NaN if the readings lie on a line.
  [[nodiscard]] Eigen::Vector3d solve() const {
    Eigen::Matrix3d squares;
    squares << uu_, uv_, u_, uv_, vv_, v_, u_, v_, count_;
    return squares.inverse() * Eigen::Vector3d(qu_, qv_, q_);
  }

 private:
  double uu_ = 0.0, uv_ = 0.0, vv_ = 0.0, u_ = 0.0, v_ = 0.0, qu_ = 0.0, qv_ = 0.0, q_ = 0.0;
  int count_ = 0;
};

class NormalFitter {
 public:
  NormalFitter(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const ScanConfig& config)
      : inverse_depth_(1.0F / depth_m), camera_(camera), config_(config) {}

  /// Zero if too little of the window is on the same surface.
  [[nodiscard]] Eigen::Vector3f at(int u, int v) const {
    const float centre = inverse_depth_.at<float>(v, u);
    const float step = static_cast<float>(config_.max_step_share) * centre;
    const int stride = std::max(1, config_.normal_radius_px / 2);
    InversePlane plane;
    int samples = 0;
    for (int y = v - config_.normal_radius_px; y <= v + config_.normal_radius_px; y += stride) {
      const float* row = y < 0 || y >= camera_.height ? nullptr : inverse_depth_.ptr<float>(y);
      for (int x = u - config_.normal_radius_px; x <= u + config_.normal_radius_px; x += stride) {
        if (row == nullptr || x < 0 || x >= camera_.width) {
          continue;
        }
        ++samples;
        if (std::abs(row[x] - centre) < step) {  // false for NaN
          plane.add(x - u, y - v, static_cast<double>(row[x]));
        }
      }
    }
    if (2 * plane.count() < samples) {
      return Eigen::Vector3f::Zero();
    }
    const Eigen::Vector3d q = plane.solve();
    const Eigen::Vector3d normal(q.x() * camera_.fx, q.y() * camera_.fy, q.z() - q.x() * (u - camera_.cx) - q.y() * (v - camera_.cy));
    if (!normal.allFinite()) {
      return Eigen::Vector3f::Zero();
    }
    return (-normal.normalized()).cast<float>();  // q > 0: the plane's normal points away from the camera
  }

 private:
  cv::Mat inverse_depth_;  ///< 1/m
  const camera::PinholeCamera& camera_;
  const ScanConfig& config_;
};

}  // namespace

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
  const NormalFitter normals(depth_m, camera, config);
  auto point = scan.points.begin();
  for (int v = 0; v < camera.height; v += config.step_px) {
    for (int u = 0; u < camera.width; u += config.step_px, ++point) {
      const double z = static_cast<double>(depth_m.at<float>(v, u));
      if (z >= config.min_range_m && z <= config.max_range_m) {
        point->point_camera = (z * camera.ray(u, v)).cast<float>();
        point->normal_camera = normals.at(u, v);
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

}  // namespace oikos::registration
