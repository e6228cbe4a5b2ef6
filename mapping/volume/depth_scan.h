// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mapping/volume/occupancy_integrator.h"
#include "mapping/volume/posed_frame.h"

namespace oikos::mapping {

/// The points of every `pixel_stride`-th pixel of every `pixel_stride`-th row that has a reading at `min_range_m` from the camera
/// or farther. The maximum is not applied here: beyond it a ray still clears (`OccupancyIntegrator`).
[[nodiscard]] OccupancyScan makeScan(const PosedFrame& posed, const OccupancyConfig& config);

}  // namespace oikos::mapping
