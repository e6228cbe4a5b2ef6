// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/pixel_terms.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "registration/pairs.h"

namespace oikos::registration {

namespace {

constexpr double kMinIncidenceCos = 0.17;  // readings at a more grazing angle are hardly any
constexpr double kOfRim = 0.05;            // of a reading's weight

/// A sensor's matching window mixes a narrow rim with what lies around it.
bool isInside(const render::View& view, int u, int v) {
  constexpr float kSameFace = 0.9F;
  const int part = view.part.at<int>(v, u);
  const auto& normal = view.normal_camera.at<cv::Vec3f>(v, u);
  const auto continues = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < view.part.cols && y < view.part.rows && view.part.at<int>(y, x) == part &&
           view.normal_camera.at<cv::Vec3f>(y, x).dot(normal) > kSameFace;
  };
  return continues(u - 1, v) && continues(u + 1, v) && continues(u, v - 1) && continues(u, v + 1);
}

/// A pixel's reading before the plane that the model has there.
struct Sight {
  double reading_m = 0.0;
  double along = 0.0;    ///< of the ray, against the normal
  double noise_m = 0.0;  ///< of the distance from the plane
  bool is_near = false;
  ModelledPixel surface;
};

Sight sightOf(const ScanPoint& seen, const Eigen::Vector3d& ray, const Eigen::Vector3d& normal_camera, double depth_m,
              const PixelSource& source) {
  Sight sight;
  sight.reading_m = static_cast<double>(seen.point_camera.z());
  sight.along = -normal_camera.dot(ray);
  sight.noise_m = residualSigma_m(sight.reading_m, sight.along / ray.norm());
  sight.surface.depth_m = depth_m;
  sight.surface.sigma_m = std::hypot(sight.noise_m, source.width_m) / sight.along;
  sight.surface.faces = seen.normal_camera.isZero() || seen.normal_camera.cast<double>().dot(normal_camera) > source.mixture.minNormalCos();
  sight.is_near = std::abs(sight.reading_m - depth_m) < 3.0 * sight.surface.sigma_m;
  return sight;
}

void count(const Sight& sight, LinkCounts& counts) {
  ++counts.read;
  counts.agreeing += sight.is_near && sight.surface.faces ? 1 : 0;
  counts.nearer += !sight.is_near && sight.reading_m < sight.surface.depth_m ? 1 : 0;
  counts.behind += !sight.is_near && sight.reading_m > sight.surface.depth_m ? 1 : 0;
}

void addSurfaceTerm(const render::View& view, int u, int v, const PixelSource& source, JointEquations& equations) {
  PixelTerm term;
  term.link = source.tree.linkOf(view.part.at<int>(v, u));
  LinkCounts& counts = equations.counts[static_cast<std::size_t>(term.link)];
  ++counts.shown;
  const ScanPoint& seen = source.scan.at(u, v);
  const auto& normal = view.normal_camera.at<cv::Vec3f>(v, u);
  const Eigen::Vector3d normal_camera = Eigen::Vector3f(normal[0], normal[1], normal[2]).cast<double>();
  const Eigen::Vector3d ray = source.scan.camera.ray(u, v);
  if (seen.point_camera.z() <= 0.0F || -normal_camera.dot(ray) < kMinIncidenceCos * ray.norm()) {
    return;
  }
  const Sight sight = sightOf(seen, ray, normal_camera, static_cast<double>(view.depth_m.at<float>(v, u)), source);
  count(sight, counts);
  if (!sight.surface.faces) {
    return;
  }
  term.reading = source.mixture.shareOfSurface(sight.reading_m, sight.surface) * (isInside(view, u, v) ? 1.0 : kOfRim);
  term.weight = term.reading / (sight.noise_m * sight.noise_m + source.surface_sigma_m * source.surface_sigma_m);
  if (term.weight <= 0.0) {
    return;
  }
  term.residual_m = sight.along * (sight.surface.depth_m - sight.reading_m);
  term.height_m = sight.along * sight.surface.depth_m;
  term.normal_map = source.T_map_camera.linear() * normal_camera;
  term.model_map = source.T_map_camera * (sight.surface.depth_m * ray);
  equations.add(term);
  if (sight.is_near) {
    equations.squares_m += term.residual_m * term.residual_m;
    ++equations.agreeing;
  }
}

}  // namespace

void addSurfaceTerms(const render::View& view, const PixelSource& source, JointEquations& equations) {
  for (int v = 0; v < source.scan.camera.height; ++v) {
    const int* parts = view.part.ptr<int>(v);
    for (int u = 0; u < source.scan.camera.width; ++u) {
      if (parts[u] >= 0) {
        addSurfaceTerm(view, u, v, source, equations);
      }
    }
  }
}

void addOutlineTerms(const render::View& view, const PixelSource& source, JointEquations& equations) {
  std::vector<Pair> pairs;
  appendEdgePairs(view, source.scan, source.edges, source.T_map_camera, 3.0 * source.width_m, pairs);
  for (const Pair& pair : pairs) {
    const double variance = pair.sigma_m * pair.sigma_m + source.surface_sigma_m * source.surface_sigma_m;
    PixelTerm term;
    term.link = source.tree.linkOf(pair.part);
    term.model_map = pair.model_map;
    term.normal_map = pair.normal_map;
    term.residual_m = pair.residual_m();
    const double share = 1.0 / (1.0 + term.residual_m * term.residual_m / (variance + source.width_m * source.width_m));
    term.weight = share * share / variance;
    term.is_outline = true;
    equations.add(term);
  }
}

}  // namespace oikos::registration
