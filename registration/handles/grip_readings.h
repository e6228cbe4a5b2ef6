// SPDX-License-Identifier: Apache-2.0
// The readings of a depth image around a handle. Included by this folder's sources and tests only.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "registration/handles/depth_view.h"
#include "registration/handles/front_plane.h"
#include "registration/handles/grip_config.h"

namespace oikos::registration {

/// What a handle is believed to be.
struct GripBelief {
  bool is_knob = false;
  Eigen::Isometry3d T_front_handle = Eigen::Isometry3d::Identity();
  double half_length_m = 0.0;
  double half_width_m = 0.0;

  [[nodiscard]] double height_m() const { return T_front_handle.translation().x(); }  ///< of the grip's middle before the front
  /// Of the plane in which the middle of what is seen is that of the grip: a bar's own; of a knob its end is seen, and part of its side.
  [[nodiscard]] double seenHeight_m() const { return is_knob ? 1.5 * height_m() : height_m(); }
  [[nodiscard]] Eigen::Isometry3d T_handle_seen() const {
    return Eigen::Isometry3d(Eigen::Translation3d(seenHeight_m() - height_m(), 0.0, 0.0));
  }
  /// Of its grip, (y, z) of the front.
  [[nodiscard]] Eigen::AlignedBox2d box_front() const;
};

/// A pixel by where its ray meets the plane of the grip: there a bar is where it is, however much of the front its reading is mixed with.
struct GripReading {
  double along_m = 0.0;
  double across_m = 0.0;
  double height_m = 0.0;  ///< of the reading before the front
};

struct GripReadings {
  std::vector<GripReading> readings;  ///< row by row
  double sigma_m = 0.0;               ///< of a height
  double share = 1.0;                 ///< of a reading's information that counts
  double pixel_m = 0.0;               ///< a pixel's width in the plane of the grip
  double spacing_m = 0.0;             ///< of the readings there
  bool faces_camera = true;
  double in_view = 0.0;  ///< share of the believed grip that lies in the image
  int shown = 0;         ///< pixels of the believed grip, one in so many; of these
  int read = 0;          ///< have a reading that may be the handle's or its front's,
  int nearer = 0;        ///< have something before them
};

[[nodiscard]] GripReadings readGrip(const GripBelief& belief, const FrontPlane& front, const DepthView& view, const GripConfig& config);

}  // namespace oikos::registration
