// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/recording/frame_stream.h"
#include "mapping/floorplan/plan_task.h"
#include "mapping/graph/back_end.h"
#include "mapping/report/report.h"
#include "mapping/volume/map_builder.h"

namespace oikos::mapping {

/// All that a mapping run knows at its end; poses in the map's frame.
struct MapFacts {
  const recording::Recording& recording;
  const recording::StreamStatistics& statistics;
  const FrontEndResult& drive;
  const BackEndResult& optimised;
  const FloorResult& floor;
  const FusedMap& fused;
  const std::vector<char>& carried;  ///< one a frame: carried by odometry
  const VolumeConfig& volume;
  bool odometry_without_mount = false;            ///< there is an odometry.txt that could not be used
  const std::optional<PlanPlacement>& placement;  ///< if there was a plan
};

[[nodiscard]] MapReport makeReport(const MapFacts& facts);

}  // namespace oikos::mapping
