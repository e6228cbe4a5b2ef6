// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"

namespace oikos::mapping {

/// A keyframe as the map's builders take it. The frame must have `depth_m` (and `color` where colours are wanted) of the
/// camera's size; it is read during the call only.
struct PosedFrame {
  const camera::RgbdFrame& frame;
  const camera::PinholeCamera& camera;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

}  // namespace oikos::mapping
