// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/known_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mapping/volume/pixel_rays.h"
#include "mapping/volume/view_batches.h"

namespace oikos::mapping {

namespace {

constexpr int kStride_px = 8;  ///< of the pixels that stand for a view

/// A depth image through a coarser grid: pixel (u, v) is the pixel (u, v) * kStride_px of the camera.
struct CoarseView {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  cv::Mat depth_m;  ///< CV_32FC1
};

std::vector<CoarseView> readCoarse(const std::vector<View>& views, const FusionInput& input) {
  std::vector<CoarseView> coarse;
  forEachBatch<CoarseView>(
      views, input, "looking for new places",
      [&](const View& view) {
        const cv::Mat depth_m = input.read(view.frame, false).depth_m;
        CoarseView read{view.T_a_camera, cv::Mat(depth_m.rows / kStride_px, depth_m.cols / kStride_px, CV_32FC1)};
        for (int v = 0; v < read.depth_m.rows; ++v) {
          for (int u = 0; u < read.depth_m.cols; ++u) {
            read.depth_m.at<float>(v, u) = depth_m.at<float>(v * kStride_px, u * kStride_px);
          }
        }
        return read;
      },
      [&](std::vector<CoarseView>& batch) { coarse.insert(coarse.end(), batch.begin(), batch.end()); });
  return coarse;
}

/// A reading of the view there, within 5 cm and 5 % of the point.
bool shows(const CoarseView& view, const Eigen::Vector3d& point_map, const camera::PinholeCamera& camera) {
  const Eigen::Vector3d p = view.T_map_camera.inverse() * point_map;
  if (p.z() < 0.1) {
    return false;
  }
  const Eigen::Vector2d px = camera.project(p) / kStride_px;
  const auto u = static_cast<int>(std::lround(px.x()));
  const auto v = static_cast<int>(std::lround(px.y()));
  if (u < 0 || v < 0 || u >= view.depth_m.cols || v >= view.depth_m.rows) {
    return false;
  }
  return std::abs(view.depth_m.at<float>(v, u) - p.z()) <= 0.05 + 0.05 * p.z();
}

double knownShare(const CoarseView& fresh, const std::vector<const CoarseView*>& alike, const camera::PinholeCamera& camera) {
  int readings = 0;
  int known = 0;
  for (int v = 0; v < fresh.depth_m.rows; ++v) {
    for (int u = 0; u < fresh.depth_m.cols; ++u) {
      const float z = fresh.depth_m.at<float>(v, u);
      if (!(z > 0.0F)) {
        continue;
      }
      const Eigen::Vector3d point_map = fresh.T_map_camera * (camera.ray(u * kStride_px, v * kStride_px) * z);
      ++readings;
      known += std::any_of(alike.begin(), alike.end(), [&](const CoarseView* view) { return shows(*view, point_map, camera); }) ? 1 : 0;
    }
  }
  return readings == 0 ? 1.0 : static_cast<double>(known) / readings;
}

}  // namespace

std::vector<char> findKnownViews(const std::vector<View>& earlier, const std::vector<View>& fresh, const FusionInput& input,
                                 const RevisionConfig& config) {
  const std::vector<CoarseView> known = readCoarse(earlier, input);
  const std::vector<CoarseView> views = readCoarse(fresh, input);
  const double min_cosine = std::cos(config.like_view_deg * std::numbers::pi / 180.0);
  std::vector<char> is_known(views.size(), 0);
  base::parallelFor(static_cast<int>(views.size()), input.threads, [&](int i) {
    const auto f = static_cast<std::size_t>(i);
    std::vector<const CoarseView*> alike;
    for (const CoarseView& view : known) {
      if (view.T_map_camera.linear().col(2).dot(views[f].T_map_camera.linear().col(2)) >= min_cosine) {
        alike.push_back(&view);
      }
    }
    is_known[f] = knownShare(views[f], alike, input.camera) >= config.known_share ? 1 : 0;
  });
  return is_known;
}

}  // namespace oikos::mapping
