// SPDX-License-Identifier: Apache-2.0
// Where a camera went after map and furniture have lost it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "core/geometry/se3.h"
#include "mapping/odometry/corner_detector.h"
#include "mapping/odometry/image_pyramid.h"
#include "mapping/odometry/landmark.h"
#include "mapping/odometry/landmark_follower.h"
#include "mapping/odometry/wheel_odometry.h"

namespace oikos::tracking {

/// A door that fills the picture shows nothing that the map knows, but it stands still: the camera's motion before it can be seen.
struct CarryConfig {
  double max_sigma_m = 0.05;       ///< of where the camera is, in each direction; worse is no pose any more
  double max_sigma_deg = 2.5;      ///< likewise of each turn
  double max_gap_s = 0.5;          ///< between two frames, without wheels to say what lies between them
  double fresh_share = 0.5;        ///< of a picture's landmarks; if fewer are seen, the next picture is held against this one
  double way_share = 0.01;         ///< deviation of a motion seen in pictures beside their noise: of the way from picture to picture,
  double turn_share = 0.01;        ///< and of the turn
  double wheel_way_share = 0.05;   ///< of what the wheels say: of the way,
  double wheel_turn_share = 0.05;  ///< of the turn,
  double wheel_sigma_m = 0.003;    ///< and of each step,
  double wheel_sigma_deg = 0.2;    ///< each turn
  mapping::WheelGate wheels{.slack_m = 0.03, .slack_deg = 2.0};  ///< pictures that the wheels contradict show something that moves
  mapping::CornerDetectorConfig corners;
  mapping::FollowerConfig follower;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_sigma_m", max_sigma_m);
    visitor("max_sigma_deg", max_sigma_deg);
    visitor("max_gap_s", max_gap_s);
    visitor("fresh_share", fresh_share);
    visitor("way_share", way_share);
    visitor("turn_share", turn_share);
    visitor("wheel_way_share", wheel_way_share);
    visitor("wheel_turn_share", wheel_turn_share);
    visitor("wheel_sigma_m", wheel_sigma_m);
    visitor("wheel_sigma_deg", wheel_sigma_deg);
    visitor("wheels", wheels);
    visitor("corners", corners);
    visitor("follower", follower);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct CarriedPose {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation (m, rad)
};

/// Carries a pose from picture to picture: by landmarks of the last picture whose place is known, as long as enough of them are seen, then
/// by those of a later one; by the wheels where pictures show nothing. What is in doubt about the first pose stays so, and each motion adds
/// to it. Not thread-safe.
class PoseCarrier {
 public:
  /// `camera` and `odometry` (may be null) outlive the carrier.
  PoseCarrier(const camera::PinholeCamera& camera, const mapping::WheelOdometry* odometry, int pyramid_levels, const CarryConfig& config);

  /// A frame whose place is known by other means: what follows is carried from here.
  void start(const camera::RgbdFrame& frame, const CarriedPose& known);
  /// A frame after the last one that was given; nothing: it cannot be told how the camera came there, or only too roughly, and then none to
  /// come is carried before the next start().
  [[nodiscard]] std::optional<CarriedPose> carry(const camera::RgbdFrame& frame);

 private:
  using Pyramid = std::shared_ptr<const mapping::ImagePyramid>;
  /// A picture that others are held against.
  struct Host {
    camera::RgbdFrame frame;
    CarriedPose pose;
    mapping::WheelWay way;                     ///< carried until then
    Pyramid pyramid;                           ///< null until it is needed,
    std::vector<mapping::Landmark> landmarks;  ///< and so are these
  };
  struct Step {
    CarriedPose pose;
    mapping::WheelWay way;  ///< carried, with this step
    bool is_fresh = false;  ///< enough of the host's landmarks are still seen
  };

  void prepare(Host& host) const;
  [[nodiscard]] std::optional<Step> byPictures(const Host& host, const camera::RgbdFrame& frame, const Pyramid& pyramid,
                                               const std::optional<Eigen::Isometry3d>& T_last_now_wheels) const;
  [[nodiscard]] std::optional<Step> byWheels(const std::optional<Eigen::Isometry3d>& T_last_now_wheels) const;
  [[nodiscard]] Eigen::Isometry3d expectedMotion(const Host& host, const Pyramid& pyramid) const;
  [[nodiscard]] bool isGoodEnough(const CarriedPose& pose) const;

  const camera::PinholeCamera& camera_;
  const mapping::WheelOdometry* odometry_;
  int pyramid_levels_;
  CarryConfig config_;
  std::optional<Host> host_;  ///< nothing: lost
  CarriedPose last_;
  mapping::WheelWay way_;  ///< carried since start()
  std::int64_t last_ns_ = 0;
  Pyramid last_pyramid_;                                             ///< null: that of the host
  Eigen::Isometry3d T_before_last_ = Eigen::Isometry3d::Identity();  ///< the last motion
};

}  // namespace oikos::tracking
