// SPDX-License-Identifier: Apache-2.0
// The plane of a front in a depth image (S236, S237). Included by this folder's sources and tests only.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "registration/handles/depth_view.h"
#include "registration/handles/front_face.h"

namespace oikos::registration {

struct FrontPlaneConfig {
  double place_sigma_m = 0.01;    ///< of where the registration has the front, along its normal,
  double tilt_sigma_deg = 0.5;    ///< and of its normal about either axis
  double gate_m = 0.03;           ///< readings farther from where it is believed are no front's
  double margin_m = 0.01;         ///< the front's outline is enlarged by this much (S237),
  double handle_margin_m = 0.03;  ///< and this much around each handle is left out
  double correlation_px = 4.0;    ///< nearer readings repeat each other
  double floor_m = 0.001;         ///< deviations that no number of readings takes away:
  double floor_deg = 0.1;         ///< of the sensor's calibration and of doors that are not quite plane
  int most_readings = 2500;       ///< that are looked at
  int min_readings = 40;          ///< of these, on the plane

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("place_sigma_m", place_sigma_m);
    visitor("tilt_sigma_deg", tilt_sigma_deg);
    visitor("gate_m", gate_m);
    visitor("margin_m", margin_m);
    visitor("handle_margin_m", handle_margin_m);
    visitor("correlation_px", correlation_px);
    visitor("floor_m", floor_m);
    visitor("floor_deg", floor_deg);
    visitor("most_readings", most_readings);
    visitor("min_readings", min_readings);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Before a front's outline, or in it.
struct FrontPlane {
  bool is_found = false;
  Eigen::Isometry3d T_camera_front = Eigen::Isometry3d::Identity();  ///< not found: as it was believed
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();              ///< of x (m) at the origin, and of its slopes along y and z
  double sigma_m = 0.0;                                              ///< of a reading, across the plane
  int readings = 0;                                                  ///< on the plane
  int nearer = 0;                                                    ///< readings of something that hides it
  std::vector<Eigen::Vector2d> hull_front;                           ///< (y, z) of the readings on it, counter-clockwise; convex
};

/// x = c + a y + b z in the believed frame, by weighted least squares with the belief as prior, readings that lie off it weighing less and
/// less (Tukey's biweight).
[[nodiscard]] FrontPlane fitFrontPlane(const FrontFace& face, const std::vector<Eigen::AlignedBox2d>& handles_front, const DepthView& view,
                                       const Eigen::Isometry3d& T_camera_front, const FrontPlaneConfig& config);

/// Whether a point lies in a convex outline, or nearer to it than `margin_m`; below 0: so far within.
[[nodiscard]] bool isWithin(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& point, double margin_m);

}  // namespace oikos::registration
