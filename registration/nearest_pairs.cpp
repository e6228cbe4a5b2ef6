// SPDX-License-Identifier: Apache-2.0
#include <nanoflann.hpp>
#include <opencv2/core.hpp>

#include "registration/pairs.h"

namespace oikos::registration {

namespace {

struct ModelPoint {
  Eigen::Vector3d point_camera;
  Eigen::Vector3d normal_camera;
  int part;
};

/// What nanoflann asks for.
struct ModelCloud {
  std::vector<ModelPoint> points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }  // NOLINT(readability-identifier-naming)
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {         // NOLINT(readability-identifier-naming)
    return points[i].point_camera[static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {  // NOLINT(readability-identifier-naming)
    return false;
  }
};

ModelCloud cloudOf(const render::View& view, const Scan& scan) {
  ModelCloud cloud;
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      const int part = view.part.at<int>(v, u);
      if (part >= 0) {
        const cv::Vec3f& normal = view.normal_camera.at<cv::Vec3f>(v, u);
        cloud.points.push_back({static_cast<double>(view.depth_m.at<float>(v, u)) * scan.camera.ray(u, v),
                                Eigen::Vector3f(normal[0], normal[1], normal[2]).cast<double>(), part});
      }
    }
  }
  return cloud;
}

}  // namespace

Pairing nearestPairs(const render::View& view, const Scan& scan, const Eigen::Isometry3d& T_map_camera, const PairRules& rules) {
  Pairing found;
  found.counts = projectivePairs(view, scan, T_map_camera, rules).counts;
  const ModelCloud cloud = cloudOf(view, scan);
  if (cloud.points.empty()) {
    return found;
  }
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, ModelCloud>, ModelCloud, 3, std::size_t>;
  const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  for (const ScanPoint& seen : scan.points) {
    if (seen.point_camera.z() <= 0.0F || seen.normal_camera.isZero()) {
      continue;
    }
    const Eigen::Vector3d point = seen.point_camera.cast<double>();
    std::size_t index = 0;
    double distance_sq = 0.0;
    if (tree.knnSearch(point.data(), 1, &index, &distance_sq) == 0 || distance_sq > rules.gate_m * rules.gate_m) {
      continue;
    }
    const ModelPoint& model = cloud.points[index];
    if (seen.normal_camera.cast<double>().dot(model.normal_camera) > rules.min_normal_cos) {
      found.pairs.push_back({T_map_camera * model.point_camera, T_map_camera.linear() * model.normal_camera, T_map_camera * point,
                             residualSigma_m(point.z(), model.normal_camera.dot(point.normalized())), model.part});
    }
  }
  return found;
}

}  // namespace oikos::registration
