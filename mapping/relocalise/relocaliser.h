// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string_view>

#include "core/base/enum_table.h"
#include "core/camera/rgbd_frame.h"
#include "core/geometry/se3.h"
#include "mapping/relocalise/local_view.h"
#include "mapping/relocalise/relocalise_config.h"
#include "mapping/relocalise/saved_map.h"

namespace oikos::mapping {

enum class LocateStatus {
  kNoPlace,            ///< no place of the map looks like the frame: unknown ground, or too little to see
  kGeometryDisagrees,  ///< places look alike, but no motion explains what is seen of them
  kRelocalised,        ///< found without a prior
  kTracked,            ///< found from where it was before, or was said to be
};
constexpr auto enumTable(LocateStatus) {
  return std::to_array<base::EnumName<LocateStatus>>({{LocateStatus::kNoPlace, "no place"},
                                                      {LocateStatus::kGeometryDisagrees, "geometry disagrees"},
                                                      {LocateStatus::kRelocalised, "relocalised"},
                                                      {LocateStatus::kTracked, "tracked"}});
}

/// Where a frame was, if it was found.
struct [[nodiscard]] LocateResult {
  LocateStatus status = LocateStatus::kNoPlace;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation (m, rad); of the map's errors too
  int keyframe = -1;                                           ///< node of the map that has seen most of what is seen
  int landmarks = 0;                                           ///< looked for
  int inliers = 0;                                             ///< of these, found where the pose has them
  double rms_px = 0.0;                                         ///< of the inliers

  [[nodiscard]] bool found() const { return status == LocateStatus::kRelocalised || status == LocateStatus::kTracked; }
};

/// Finds single frames in a saved map without any prior (S39-S40): likely places by their features, three-point RANSAC on features with
/// depth against each, then the landmarks of all keyframes about, aligned photometrically. Thread-safe; the answer depends on the frame,
/// its index, and the seed only.
class Relocaliser {
 public:
  /// `map` outlives the relocaliser.
  Relocaliser(const SavedMap& map, const RelocaliseConfig& config, std::uint64_t seed) : map_(map), config_(config), seed_(seed) {}

  /// `frame.gray` and `depth_m` are of the map's camera.
  LocateResult find(const LocatedFrame& located) const;
  /// From a pose that is right to some pixels, or centimetres: no features are needed.
  LocateResult findNear(const LocatedFrame& located, const Eigen::Isometry3d& T_map_camera) const;

  [[nodiscard]] const RelocaliseConfig& config() const { return config_; }
  [[nodiscard]] const SavedMap& map() const { return map_; }

 private:
  const SavedMap& map_;
  RelocaliseConfig config_;
  std::uint64_t seed_;
};

}  // namespace oikos::mapping
