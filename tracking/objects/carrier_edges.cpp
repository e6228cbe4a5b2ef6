// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/carrier_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/camera/depth_noise.h"

namespace oikos::tracking {

namespace {

constexpr int kStep_px = 4;
constexpr double kInner_m = 0.05;  // a push by so much leaves half of an outline's inner side empty
constexpr int kMaxInner_px = 4;

/// A coarse picture of the home beside the readings in its pixels.
struct Coarse {
  const BelievedScene& scene;
  const DepthView& view;
  camera::PinholeCamera camera;
  render::View believed;
  const ObjectSightConfig& config;

  [[nodiscard]] int model(int u, int v) const { return scene.modelOf(believed.part.at<int>(v, u)); }
  [[nodiscard]] double depth_m(int u, int v) const { return static_cast<double>(believed.depth_m.at<float>(v, u)); }
  [[nodiscard]] double reading_m(int u, int v) const { return static_cast<double>(view.depth_m.at<float>(kStep_px * v, kStep_px * u)); }
  [[nodiscard]] double tolerance_m(double depth, double place_sigma_m) const {
    return config.sigmas * std::hypot(camera::depthSigma_m(depth), place_sigma_m);
  }
};

double placeSigma_m(const Coarse& coarse, int u, int v) {
  const Eigen::Vector3d point_map = coarse.view.T_map_camera * (coarse.depth_m(u, v) * coarse.camera.ray(u, v));
  return std::hypot(coarse.config.carried_sigma_m, poseSigma_m(coarse.view, point_map));
}

/// A few pixels on, the picture shows something that is clearly behind.
bool isAtEdge(const Coarse& coarse, int u, int v, double tolerance_m) {
  const double depth_m = coarse.depth_m(u, v);
  const int reach = std::clamp(static_cast<int>(std::ceil(kInner_m * coarse.camera.fx / depth_m)), 1, kMaxInner_px);
  constexpr std::array<std::array<int, 2>, 4> kSides = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  return std::any_of(kSides.begin(), kSides.end(), [&](const std::array<int, 2>& side) {
    const int beside_u = u + reach * side[0];
    const int beside_v = v + reach * side[1];
    if (beside_u < 0 || beside_v < 0 || beside_u >= coarse.camera.width || beside_v >= coarse.camera.height) {
      return false;
    }
    return coarse.model(beside_u, beside_v) != coarse.model(u, v) && coarse.depth_m(beside_u, beside_v) > depth_m + 2.0 * tolerance_m;
  });
}

void countPixel(const Coarse& coarse, int u, int v, EdgeCount& count) {
  const double reading_m = coarse.reading_m(u, v);
  const double depth_m = coarse.depth_m(u, v);
  if (!(reading_m > 0.0)) {
    return;
  }
  const double tolerance_m = coarse.tolerance_m(depth_m, placeSigma_m(coarse, u, v));
  if (reading_m < depth_m - tolerance_m || !isAtEdge(coarse, u, v, tolerance_m)) {
    return;
  }
  ++count.pixels;
  count.through += reading_m > depth_m + tolerance_m ? 1 : 0;
}

}  // namespace

std::map<int, EdgeCount> countEdges(const BelievedScene& scene, const std::set<int>& models, const DepthView& view,
                                    const ObjectSightConfig& config) {
  std::map<int, EdgeCount> counts;
  if (models.empty()) {
    return counts;
  }
  const camera::PinholeCamera camera = cropped(view.camera, {0, 0, view.camera.width, view.camera.height}, kStep_px);
  const Coarse coarse{scene, view, camera, scene.view(camera, view.T_map_camera), config};
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int model = coarse.model(u, v);
      if (models.contains(model)) {
        countPixel(coarse, u, v, counts[model]);
      }
    }
  }
  return counts;
}

}  // namespace oikos::tracking
