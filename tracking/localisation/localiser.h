// SPDX-License-Identifier: Apache-2.0
// Map, home and registration together: where the camera was.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "core/geometry/se3.h"
#include "mapping/odometry/wheel_odometry.h"
#include "mapping/relocalise/map_tracker.h"
#include "registration/landmark/landmark_refiner.h"
#include "registration/scan.h"
#include "tracking/localisation/home_landmarks.h"
#include "tracking/localisation/pose_carrier.h"
#include "tracking/localisation/pose_prior.h"

namespace oikos::tracking {

struct LocaliseConfig {
  mapping::RelocaliseConfig map;
  registration::ScanConfig scan;
  registration::LandmarkConfig landmarks;
  LandmarkChoice furniture;
  CarryConfig carry;
  double prior_sigma_m = 0.05;       ///< of a given prior's x and y each
  double prior_sigma_deg = 3.0;      ///< and of its yaw
  double map_prior_sigma_m = 0.02;   ///< how well map and furniture agree about the place,
  double map_prior_sigma_deg = 1.0;  ///< and the heading

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("map", map);
    visitor("scan", scan);
    visitor("landmarks", landmarks);
    visitor("furniture", furniture);
    visitor("carry", carry);
    visitor("prior_sigma_m", prior_sigma_m);
    visitor("prior_sigma_deg", prior_sigma_deg);
    visitor("map_prior_sigma_m", map_prior_sigma_m);
    visitor("map_prior_sigma_deg", map_prior_sigma_deg);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// What a pose rests on.
enum class PoseSource {
  kNone,       ///< not found
  kCarried,    ///< not found either, but carried on from the last pose that was
  kMap,        ///< seen again in the saved map
  kLandmarks,  ///< and, or after a prior, refined by furniture
};
constexpr auto enumTable(PoseSource) {
  return std::to_array<base::EnumName<PoseSource>>(
      {{PoseSource::kNone, "none"}, {PoseSource::kCarried, "carried"}, {PoseSource::kMap, "map"}, {PoseSource::kLandmarks, "landmarks"}});
}

struct LocatedPose {
  int frame = -1;
  std::int64_t stamp_ns = 0;
  PoseSource source = PoseSource::kNone;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation (m, rad)
  std::optional<Eigen::Isometry3d> T_map_camera_before;        ///< what the landmarks refined: from the map, or the prior
  mapping::LocateResult in_map;                                ///< of a localiser with a map
  std::optional<registration::LandmarkRefinement> landmarks;   ///< if there was something to refine

  [[nodiscard]] bool isFound() const { return source == PoseSource::kMap || source == PoseSource::kLandmarks; }
};

/// What a localiser works with; all of it outlives it. Without a map a prior is needed, without furniture there is no refinement.
struct LocaliserTools {
  const camera::PinholeCamera& camera;
  const mapping::Relocaliser* relocaliser = nullptr;
  registration::LandmarkScene* furniture = nullptr;
  std::optional<int> only = std::nullopt;  ///< one landmark on demand (S210)
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  const PosePrior* prior = nullptr;
  const mapping::WheelOdometry* odometry = nullptr;
};

/// Finds a drive's frames, one after the other: in the map without a prior, tracked on, then refined by the furniture in view. Where
/// neither tells the place, the last one is carried on with the camera's own motion. Not thread-safe.
class Localiser {
 public:
  Localiser(const LocaliserTools& tools, const LocaliseConfig& config);

  /// `frame.gray` and `depth_m` are needed.
  LocatedPose add(const camera::RgbdFrame& frame);
  /// The same, but a frame that the map has found is not refined by furniture: where only some of the frames matter, refine() these.
  LocatedPose addUnrefined(const camera::RgbdFrame& frame);
  /// By the furniture in view, if there is some; one that was refined before stays as it is. In any order.
  void refine(const camera::RgbdFrame& frame, LocatedPose& located) const;

 private:
  [[nodiscard]] LocatedPose locate(const camera::RgbdFrame& frame);
  LocatedPose concluded(const camera::RgbdFrame& frame, LocatedPose located);
  static void take(const std::optional<CarriedPose>& carried, LocatedPose& located);
  [[nodiscard]] registration::CameraPrior priorOf(const LocatedPose& located, const Eigen::Isometry3d& T_map_camera) const;
  [[nodiscard]] std::optional<Eigen::Isometry3d> predict(std::int64_t stamp_ns) const;

  LocaliserTools tools_;
  LocaliseConfig config_;
  std::optional<mapping::MapTracker> tracker_;
  PoseCarrier carrier_;
  std::optional<LocatedPose> last_;  ///< found or carried
  bool is_carrying_ = false;         ///< the last frame was not found
};

}  // namespace oikos::tracking
