// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "mapping/mapper.h"
#include "tools/command.h"

namespace oikos::tools {

struct MapJob {
  const recording::Recording& recording;
  std::filesystem::path home;
  mapping::MapConfig config;
  std::optional<Eigen::Isometry3d> T_base_camera;        ///< the mount
  std::optional<mapping::PlanTask> plan = std::nullopt;  ///< a drawing; a home that has outlines is its own
  bool extend = false;                                   ///< go on with the map that is there, in its frame
};

/// Maps a drive into a home, which is made if there is none: the old map or the new one is there at any time. Rooms with outlines get their
/// clouds, and the map ends in their frame, wherever the drive began. Throws Error; kInput if the map does not fit, kUsage for a drawing
/// beside outlines.
/// A map that is extended stays as it is when the drive is not placed in it, and if the home has none that is kUsage.
mapping::MapResult mapIntoHome(const MapJob& job, const Session& session);

}  // namespace oikos::tools
