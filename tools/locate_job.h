// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "semantic/model/home.h"
#include "tools/command.h"
#include "tools/floor_place.h"
#include "tracking/localisation/localiser.h"

namespace oikos::tools {

struct LocateJob {
  const recording::Recording& recording;
  std::filesystem::path home;
  tracking::LocaliseConfig config;
  std::optional<Eigen::Isometry3d> T_base_camera;
  std::filesystem::path prior = {};       ///< TUM file, `T_map_base`; empty: none
  std::optional<FloorPlace> from = {};    ///< where the robot was at the first frame
  const semantic::Home* known = nullptr;  ///< whose fixed furniture to refine by; null: the map's answer as it is
  std::string object = {};                ///< the one landmark to refine by; empty: all
  std::int64_t seed = 0;
};

/// Features and landmarks are looked for as when the home's map was made. To be changed by what the user says.
[[nodiscard]] tracking::LocaliseConfig localiseConfigOf(const std::filesystem::path& home, int threads);

/// All that a localiser works with, opened: the home's map if it has one, the known furniture, and the prior.
class LocateWorkshop {
 public:
  /// The job outlives it. Throws Error: kUsage where there is neither map nor prior, or neither map nor furniture; kInput for a map of
  /// another camera, and a prior without a known mount.
  explicit LocateWorkshop(const LocateJob& job);
  ~LocateWorkshop();

  /// The workshop outlives it.
  [[nodiscard]] tracking::Localiser makeLocaliser() const;

 private:
  struct Tools;
  void openMap();
  void openFurniture();
  void openPrior();

  const LocateJob& job_;
  std::unique_ptr<Tools> tools_;
};

struct Located {
  std::vector<tracking::LocatedPose> poses;  ///< one a frame that could be read
  int unreadable = 0;
  double opening_s = 0.0;  ///< of map and home
};

/// Finds the frames of a recording in a home. Throws as LocateWorkshop.
[[nodiscard]] Located locateRecording(const LocateJob& job, const Session& session);

}  // namespace oikos::tools
