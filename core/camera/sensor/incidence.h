// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/ideal_view.h"

namespace oikos::camera {

/// cos(theta) of the angle between each pixel's ray and the surface's normal, for one row: 1 = seen frontally, 0 = grazing or nothing hit.
void fillIncidenceCosines(const cv::Mat& normal_camera, const PinholeCamera& camera, int v, float* cosines);

/// theta / (pi/2 - theta), by which published models let noise grow with the angle; theta is taken as 85 degrees beyond that.
[[nodiscard]] float incidenceRatio(float cosine);

}  // namespace oikos::camera
