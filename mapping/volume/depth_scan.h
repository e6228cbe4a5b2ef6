// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "mapping/volume/occupancy_integrator.h"

namespace oikos::mapping {

/// A keyframe as the map's builders take it. The frame must have `depth_m` (and `color` where colours are wanted) of the
/// camera's size.
struct PosedFrame {
  const camera::RgbdFrame& frame;
  const camera::PinholeCamera& camera;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// The points of every `pixel_stride`-th pixel of every `pixel_stride`-th row that has a reading at `min_range_m` from the camera
/// or farther. The maximum is not applied here: beyond it a ray still clears (`OccupancyIntegrator`).
[[nodiscard]] OccupancyScan makeScan(const PosedFrame& posed, const OccupancyConfig& config);

}  // namespace oikos::mapping
