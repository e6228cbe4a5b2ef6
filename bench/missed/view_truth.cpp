// SPDX-License-Identifier: Apache-2.0
#include "bench/missed/view_truth.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/render/camera_rays.h"
#include "core/render/view.h"
#include "tests/registration/furniture_scan.h"

namespace oikos::bench {

namespace {

Pixels pixelsOf(int model, const render::Scene& scene, const render::View& view) {
  Pixels pixels;
  for (int v = 0; v < view.part.rows; ++v) {
    for (int u = 0; u < view.part.cols; ++u) {
      const int part = view.part.at<int>(v, u);
      if (part >= 0 && scene.parts()[static_cast<std::size_t>(part)].model == model) {
        pixels.emplace_back(u, v);
      }
    }
  }
  return pixels;
}

/// How many pixels it would have if nothing were before it.
std::size_t pixelsAlone(int model, const render::Scene& scene, const Eigen::Isometry3d& T_map_camera, const render::ViewConfig& config) {
  render::Scene alone;
  for (const render::ScenePart& part : scene.parts()) {
    if (part.model == model) {
      alone.add(part.mesh_part, part.T_map_part);
    }
  }
  alone.commit();
  return static_cast<std::size_t>(
      cv::countNonZero(render::renderView(alone, render::CameraRays(test::kinectCamera()), {T_map_camera, {}}, config).part >= 0));
}

}  // namespace

std::map<std::string, Pixels> seenIn(const simulate::World& world, const Eigen::Isometry3d& T_map_camera) {
  constexpr std::size_t kMinPixels = 150;
  constexpr double kMaxRange_m = 3.4;
  render::ViewConfig config;
  config.with_parts = true;
  const camera::PinholeCamera camera = test::kinectCamera();
  const render::View all = render::renderView(world.scene(), render::CameraRays(camera), {T_map_camera, {}}, config);
  std::map<std::string, Pixels> seen;
  for (const auto& [id, small] : world.smallPieces()) {
    if ((small.T_map_object.translation() - T_map_camera.translation()).norm() > kMaxRange_m) {
      continue;
    }
    Pixels pixels = pixelsOf(small.model, world.scene(), all);
    const bool is_cut = std::any_of(pixels.begin(), pixels.end(), [&](const cv::Point& pixel) {
      return pixel.x == 0 || pixel.y == 0 || pixel.x == camera.width - 1 || pixel.y == camera.height - 1;
    });
    if (!is_cut && pixels.size() >= kMinPixels && 2 * pixels.size() >= pixelsAlone(small.model, world.scene(), T_map_camera, config)) {
      seen[id] = std::move(pixels);
    }
  }
  return seen;
}

bool isMeasured(const Pixels& pixels, const cv::Mat& depth_m) {
  const auto measured =
      std::count_if(pixels.begin(), pixels.end(), [&](const cv::Point& pixel) { return depth_m.at<float>(pixel) > 0.0F; });
  return 2 * static_cast<std::size_t>(measured) >= pixels.size();
}

}  // namespace oikos::bench
