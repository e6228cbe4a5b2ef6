// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "tools/command.h"
#include "tools/floor_place.h"
#include "tracking/localisation/localiser.h"

namespace oikos::tools {

struct LocateJob {
  const recording::Recording& recording;
  std::filesystem::path home;
  std::optional<Eigen::Isometry3d> T_base_camera;
  std::filesystem::path prior;        ///< TUM file, `T_map_base`; empty: none
  std::optional<FloorPlace> from;     ///< where the robot was at the first frame
  std::string object;                 ///< the one landmark to refine by; empty: all
  bool has_landmarks = true;          ///< false: the map's answer as it is
  std::vector<std::string> settings;  ///< KEY=VALUE
};

struct Located {
  std::vector<tracking::LocatedPose> poses;  ///< one a frame that could be read
  int unreadable = 0;
  double opening_s = 0.0;  ///< of map and home
};

/// Finds the frames of a recording in a home: by its map if it has one, by its fixed furniture if it has some. Throws Error: kUsage where
/// there is neither map nor prior, or neither map nor furniture; kInput for a map of another camera, and a prior without a known mount.
[[nodiscard]] Located locateRecording(const LocateJob& job, const Session& session);

}  // namespace oikos::tools
