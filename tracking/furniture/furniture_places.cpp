// SPDX-License-Identifier: Apache-2.0
#include "tracking/furniture/furniture_places.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "core/base/degrees.h"

namespace oikos::tracking {

std::vector<FurnitureView> viewsFor(const semantic::LargeObject& object, const std::vector<FurnitureView>& frames,
                                    const camera::PinholeCamera& camera, const MovedFurnitureConfig& config) {
  constexpr double kMiddle_m = 0.4;  // above the floor, of furniture
  const Eigen::Vector3d middle_map = object.T_map_object.toIsometry() * Eigen::Vector3d(0.0, 0.0, kMiddle_m);
  std::vector<std::pair<double, const FurnitureView*>> in_view;
  for (const FurnitureView& frame : frames) {
    const Eigen::Vector3d middle_camera = frame.T_map_camera.inverse() * middle_map;
    const double away_m = middle_camera.norm();
    if (away_m <= config.max_distance_m && middle_camera.z() > 0.3 && camera.contains(camera.project(middle_camera))) {
      in_view.emplace_back(std::abs(away_m - config.best_distance_m), &frame);
    }
  }
  std::stable_sort(in_view.begin(), in_view.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const double max_cosine = std::cos(config.view_apart_deg * base::kRadPerDeg);
  std::vector<FurnitureView> chosen;
  for (const auto& [rank, frame] : in_view) {
    const Eigen::Vector3d bearing = (frame->T_map_camera.translation() - middle_map).normalized();
    const bool is_apart = std::all_of(chosen.begin(), chosen.end(), [&](const FurnitureView& other) {
      return bearing.dot((other.T_map_camera.translation() - middle_map).normalized()) < max_cosine;
    });
    if (is_apart && static_cast<int>(chosen.size()) < config.views) {
      chosen.push_back(*frame);
    }
  }
  std::sort(chosen.begin(), chosen.end(), [](const FurnitureView& a, const FurnitureView& b) { return a.frame < b.frame; });
  return chosen;
}

mapping::LocatedScan halvedScan(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) {
  mapping::LocatedScan scan;
  scan.camera = {camera.width / 2, camera.height / 2, camera.fx / 2.0, camera.fy / 2.0, camera.cx / 2.0, camera.cy / 2.0};
  scan.T_map_camera = T_map_camera;
  scan.depth_m = cv::Mat(scan.camera.height, scan.camera.width, CV_32FC1);
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      scan.depth_m.at<float>(v, u) = depth_m.at<float>(2 * v, 2 * u);
    }
  }
  return scan;
}

std::optional<MovedPiece> placeOf(const semantic::Home& home, const std::filesystem::path& home_folder, const semantic::ObjectId& id,
                                  const std::vector<mapping::LocatedScan>& scans, MovedFurnitureConfig config) {
  semantic::Home alone = home;
  for (semantic::Room& room : alone.rooms) {
    std::erase_if(room.objects, [&](const semantic::LargeObject& object) { return object.id != id; });
  }
  config.min_moved_m = 0.0;
  config.min_moved_deg = 0.0;
  const std::vector<MovedPiece> found = findMovedFurniture(alone, home_folder, scans, {}, config);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

}  // namespace oikos::tracking
