// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config_rules.h"
#include "core/base/enum_table.h"
#include "core/base/progress.h"
#include "core/recording/recording.h"

namespace oikos::mapping {

enum class FeatureKind { kSift, kOrb };
constexpr auto enumTable(FeatureKind /*unused*/) {
  return std::to_array<base::EnumName<FeatureKind>>({{FeatureKind::kSift, "sift"}, {FeatureKind::kOrb, "orb"}});
}

struct VolumeConfig {
  double resolution_m = 0.05;  ///< edge of a voxel
  bool every_frame = false;    ///< integrate every frame, not the keyframes only

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("resolution_m", resolution_m);
    visitor("every_frame", every_frame);
  }
  [[nodiscard]] std::vector<std::string> validate() const {
    return base::ConfigRules().between("resolution_m", resolution_m, 0.01, 1.0).messages();
  }
};

struct MapConfig {
  FeatureKind features = FeatureKind::kSift;  ///< for keyframes, loops and relocalisation
  VolumeConfig volume;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("features", features);
    visitor("volume", volume);
  }
};

/// What a run gets beside its configuration.
struct MapRun {
  int threads = 1;
  std::int64_t seed = 0;
  std::optional<Eigen::Isometry3d> T_base_camera;  ///< the camera's mount, if it is known
  base::ProgressSink progress;
};

/// What came of it, for the summary; the whole of it stands in `report.json`.
struct [[nodiscard]] MapResult {
  int frames = 0;
  int skipped_frames = 0;  ///< could not be read
  int lost_frames = 0;     ///< have the pose of the last one that was not lost
  int keyframes = 0;
  int loops = 0;
  int submaps = 0;  ///< parts of the drive that no loop has joined; 1 is what one wants
  bool floor_found = false;
};

/// Writes every file of `map/` into `map_folder`, which exists and is empty. Throws base::Error.
MapResult buildMap(const recording::Recording& recording, const MapConfig& config, const MapRun& run,
                   const std::filesystem::path& map_folder);

}  // namespace oikos::mapping
