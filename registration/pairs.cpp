// SPDX-License-Identifier: Apache-2.0
#include "registration/pairs.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/camera/depth_noise.h"

namespace oikos::registration {

namespace {

constexpr double kMinIncidenceCos = 0.17;  // readings at a more grazing angle are hardly any

}  // namespace

/// A pixel's lateral jitter (half a pixel, Khoshelham & Elberink 2012) adds to the depth's noise where the surface is seen at an angle.
double residualSigma_m(double depth_m, double normal_dot_ray) {
  constexpr double kLateralSigma = 0.5 / 525.0;
  const double cosine = std::abs(normal_dot_ray);
  const double across = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double along_m = camera::depthSigma_m(depth_m) * cosine;
  const double beside_m = depth_m * kLateralSigma * across;
  return std::sqrt(along_m * along_m + beside_m * beside_m);
}

Pairing projectivePairs(const render::View& view, const Scan& scan, const Eigen::Isometry3d& T_map_camera, const PairRules& rules) {
  OIKOS_CHECK(view.depth_m.cols == scan.camera.width && view.depth_m.rows == scan.camera.height);
  Pairing found;
  found.pairs.reserve(scan.points.size() / 2);
  for (int v = 0; v < scan.camera.height; ++v) {
    const auto* depth_m = view.depth_m.ptr<float>(v);
    const auto* normals = view.normal_camera.ptr<cv::Vec3f>(v);
    const auto* parts = view.part.ptr<int>(v);
    for (int u = 0; u < scan.camera.width; ++u) {
      if (parts[u] < 0) {
        continue;
      }
      ++found.counts.model;
      const ScanPoint& seen = scan.at(u, v);
      const Eigen::Vector3d ray = scan.camera.ray(u, v);
      const Eigen::Vector3d normal(static_cast<double>(normals[u][0]), static_cast<double>(normals[u][1]),
                                   static_cast<double>(normals[u][2]));
      const double along = normal.dot(ray);
      if (seen.point_camera.z() <= 0.0F || -along < kMinIncidenceCos * ray.norm()) {
        ++found.counts.unread;
        continue;
      }
      const double residual_m = along * static_cast<double>(seen.point_camera.z() - depth_m[u]);
      const bool faces = seen.normal_camera.isZero() || seen.normal_camera.cast<double>().dot(normal) > rules.min_normal_cos;
      if (residual_m > rules.gate_m) {
        ++found.counts.occluded;
      } else if (residual_m < -rules.gate_m) {
        ++found.counts.seen_through;
      } else if (!faces) {
        ++found.counts.turned;
      } else {
        const double depth = static_cast<double>(seen.point_camera.z());
        found.pairs.push_back({T_map_camera * (static_cast<double>(depth_m[u]) * ray), T_map_camera.linear() * normal,
                               T_map_camera * seen.point_camera.cast<double>(), residualSigma_m(depth, along / ray.norm()), parts[u]});
      }
    }
  }
  return found;
}

}  // namespace oikos::registration
