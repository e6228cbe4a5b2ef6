// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/point_cloud.h"
#include "core/recording/trajectory.h"
#include "semantic/model/home.h"

namespace oikos::demo {

struct FloorPicture {
  const geometry::ColoredCloud& cloud_map;
  const semantic::Home& home;
  const recording::Trajectory& T_map_base;  ///< the way driven
};

/// The home from above, north (y) up: the map's points without the ceiling, the rooms' outlines, each piece of furniture with its name,
/// doors and drawers as far as they are open, small objects as dots. CV_8UC3, BGR.
[[nodiscard]] cv::Mat drawFloor(const FloorPicture& picture);

}  // namespace oikos::demo
