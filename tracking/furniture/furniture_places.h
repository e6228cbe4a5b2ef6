// SPDX-License-Identifier: Apache-2.0
// Where a recording has the home's shiftable furniture, moved or not.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "tracking/furniture/moved_furniture.h"

namespace oikos::tracking {

/// A piece where most views have it.
struct FurniturePlace {
  semantic::ObjectId id;
  Eigen::Isometry3d T_map_object = Eigen::Isometry3d::Identity();
  int views = 0;  ///< that agree
  double spread_m = 0.0;
  double fit = 0.0;           ///< share of the model that the worst of them explains
  std::int64_t stamp_ns = 0;  ///< of the first view that was asked
  int frame = 0;              ///< that view, of the recording
};

/// A frame that could be a view.
struct FurnitureView {
  int frame = 0;
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// The frames, a few, that look at where the piece is believed to stand, from directions apart, the nearest to the best distance first; in
/// the order of time. Without their images nothing more can be told of them.
[[nodiscard]] std::vector<FurnitureView> viewsFor(const semantic::LargeObject& object, const std::vector<FurnitureView>& frames,
                                                  const camera::PinholeCamera& camera, const MovedFurnitureConfig& config);

/// Every other pixel of every other row, as findMovedFurniture() wants a scan.
[[nodiscard]] mapping::LocatedScan halvedScan(const cv::Mat& depth_m, const camera::PinholeCamera& camera,
                                              const Eigen::Isometry3d& T_map_camera);

/// Where these views have the piece; nothing: they do not agree. `home`: that it is of. Throws as findMovedFurniture().
[[nodiscard]] std::optional<MovedPiece> placeOf(const semantic::Home& home, const std::filesystem::path& home_folder,
                                                const semantic::ObjectId& id, const std::vector<mapping::LocatedScan>& scans,
                                                MovedFurnitureConfig config);

}  // namespace oikos::tracking
