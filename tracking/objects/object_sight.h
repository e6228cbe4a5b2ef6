// SPDX-License-Identifier: Apache-2.0
// What one depth image says of whether a small object is in its place: the home as it is believed to look, with the object and without it,
// against the readings, pixel by pixel.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "core/base/enum_table.h"
#include "core/camera/pinhole_camera.h"
#include "core/geometry/se3.h"
#include "registration/scan.h"
#include "tracking/objects/believed_scene.h"
#include "tracking/objects/object_config.h"

namespace oikos::tracking {

enum class SightVerdict {
  kUnclear,   ///< too small, grazing, too near to what is behind it, not measured, or the pose or the carrier's place is too unsure
  kHidden,    ///< something stands before it
  kThere,     ///< something is in its place, or about it; which thing is not said
  kNotThere,  ///< in plain view: readings behind it, and nothing about its place that the home does not explain
};
constexpr auto enumTable(SightVerdict) {
  return std::to_array<base::EnumName<SightVerdict>>({{SightVerdict::kUnclear, "unclear"},
                                                      {SightVerdict::kHidden, "hidden"},
                                                      {SightVerdict::kThere, "there"},
                                                      {SightVerdict::kNotThere, "not there"}});
}

/// A depth image and where it was taken.
struct DepthView {
  const cv::Mat& depth_m;  ///< CV_32FC1, of the camera's size; NaN = no reading
  const camera::PinholeCamera& camera;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation (m, rad)
};

struct ObjectSight {
  SightVerdict verdict = SightVerdict::kUnclear;
  bool is_blind = false;        ///< unclear for want of readings, not since none could tell: another image may do better
  int pixels = 0;               ///< that should show the object; of these:
  int missing = 0;              ///< without a reading
  int hidden = 0;               ///< with a reading before it that is not about its place
  int core = 0;                 ///< so far from its outline that errors of pose and place leave them on it, with a reading not before it;
  int telling = 0;              ///< of these, with a reading that tells it from what is behind,
  int through = 0;              ///< and is of what is behind
  int matter = 0;               ///< readings about its place that nothing else in the home explains
  int carrier = 0;              ///< readings of the carrier beside it,
  int carrier_agrees = 0;       ///< where it should be
  int around = 0;               ///< readings of anything that the home has beside it,
  int around_agrees = 0;        ///< where that should be
  double against = 0.0;         ///< its word against the object being there: 1 of kNotThere, less where too few pixels tell for that; or 0
  double sigma_m = 0.0;         ///< of the object's place as the camera has it, without depth noise
  registration::PixelBox crop;  ///< around its place
};

/// The box's pixels with `around_m` on all sides, within the picture; empty: none, or it reaches behind the camera.
[[nodiscard]] registration::PixelBox pixelsAround(const Eigen::AlignedBox3d& box_object, const Eigen::Isometry3d& T_camera_object,
                                                  const camera::PinholeCamera& camera, double around_m);

/// The camera that sees only those pixels, every `step_px`-th of each row and column.
[[nodiscard]] camera::PinholeCamera cropped(const camera::PinholeCamera& camera, const registration::PixelBox& box, int step_px = 1);

/// Standard deviation of a point of map as the camera has it, along the axis where it is largest (m).
[[nodiscard]] double poseSigma_m(const DepthView& view, const Eigen::Vector3d& point_map);

/// `scene`: at the image's time, where the object stands at `stand`. Whether a carrier that can be pushed is where it should be is
/// not asked here.
[[nodiscard]] ObjectSight lookAt(BelievedScene& scene, std::size_t object, const ObjectStand& stand, const DepthView& view,
                                 const ObjectSightConfig& config);

}  // namespace oikos::tracking
