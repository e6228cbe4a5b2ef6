// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/progress.h"
#include "core/recording/recording.h"
#include "mapping/extend/revision.h"
#include "mapping/floorplan/plan_task.h"
#include "mapping/graph/back_end.h"
#include "mapping/graph/front_end.h"
#include "mapping/graph/pairwise_front_end.h"
#include "mapping/report/report.h"
#include "mapping/volume/map_builder.h"

namespace oikos::mapping {

enum class FrontEndKind {
  kLandmarks,  ///< landmarks followed from frame to frame
  kPairwise,   ///< the papers': features matched frame by frame
};
constexpr auto enumTable(FrontEndKind) {
  return std::to_array<base::EnumName<FrontEndKind>>({{FrontEndKind::kLandmarks, "landmarks"}, {FrontEndKind::kPairwise, "pairwise"}});
}

struct MapConfig {
  FrontEndKind kind = FrontEndKind::kLandmarks;
  FrontEndConfig front_end;  ///< features and motion serve both kinds
  PairwiseConfig pairwise;
  BackEndConfig back_end;
  VolumeConfig volume;
  WallScanConfig walls;
  PlanFitConfig floor_plan;
  RevisionConfig revision;    ///< of a map that is extended
  int images_in_memory = 40;  ///< keyframe pyramids kept; the others are read again

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("kind", kind);
    visitor("front_end", front_end);
    visitor("pairwise", pairwise);
    visitor("back_end", back_end);
    visitor("volume", volume);
    visitor("walls", walls);
    visitor("floor_plan", floor_plan);
    visitor("revision", revision);
    visitor("images_in_memory", images_in_memory);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// What someone who knows the furniture makes of changes, by the drive's located views; asked once, before the report is written.
using ExplainChanges = std::function<ChangeExplanation(const std::vector<Change>& changes, const std::vector<LocatedScan>& scans)>;

/// What a run gets beside its configuration.
struct MapRun {
  int threads = 1;
  std::int64_t seed = 0;
  std::optional<Eigen::Isometry3d> T_base_camera =
      std::nullopt;                             ///< the camera's mount; nothing: that of the recording's calibration, if it has one
  std::optional<PlanTask> plan = std::nullopt;  ///< the map is laid onto it; without one its frame is the base at the first frame
  std::filesystem::path extended = {};          ///< the `map` folder that the drive goes on with; empty: a new map. It has a frame: no plan
  ExplainChanges explain = {};                  ///< nothing: changes stay without names
  base::ProgressSink progress = {};
};

/// What came of it, for the summary; the whole of it stands in `report.json`.
struct [[nodiscard]] MapResult {
  int frames = 0;
  int skipped_frames = 0;     ///< could not be read
  int lost_frames = 0;        ///< have a pose between, or of, those about them
  int carried_frames = 0;     ///< could not be followed either, but odometry moved them on
  int keyframes = 0;          ///< of the map
  int earlier_keyframes = 0;  ///< of these, those that it had before
  int loops = 0;
  int submaps = 0;  ///< parts of the drive that no loop has joined; 1 is what one wants
  bool floor_found = false;
  std::optional<PlanPlacement> placement = std::nullopt;  ///< if there was a plan
  bool is_placed = true;               ///< false: the drive has no place in the map that it was to extend, and nothing was written
  std::vector<Change> changes = {};    ///< between the map that was extended and the drive
  ChangeExplanation explanation = {};  ///< of them
};

/// Builds the metric map of a recorded drive, or extends one by another drive (S21): track → close loops → refine → find the floor → lay it
/// onto the plan → fuse. Writes every file of `map/` into `map_folder`, which exists and is empty. Throws base::Error; kInput for a plan
/// that does not fit, before anything is fused. A drive that extends a map is placed in it by loops, both are optimised together in the
/// map's frame, what has gone is erased from the earlier keyframes, and everything is fused anew from the keyframes of all drives.
MapResult buildMap(const recording::Recording& recording, const MapConfig& config, const MapRun& run,
                   const std::filesystem::path& map_folder);

}  // namespace oikos::mapping
