// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "core/recording/trajectory.h"
#include "mapping/extend/carried_frames.h"
#include "mapping/extend/map_frames.h"
#include "mapping/extend/revision.h"
#include "mapping/graph/back_end.h"
#include "mapping/graph/front_end.h"
#include "mapping/mapper.h"

namespace oikos::mapping {

/// The map that the run extends; null if it extends none. Throws Error: kUsage if there is no such map, or if this configuration cannot go
/// on with it, kInput if it was made with another camera or is damaged.
[[nodiscard]] std::unique_ptr<const EarlierMap> openEarlierMap(const recording::Recording& recording, const MapConfig& config,
                                                               const MapRun& run);

/// What a drive has to do with the map that it extends, between optimisation and fusion. `drive` and `optimised` are those of both.
class MapExtension {
 public:
  explicit MapExtension(const EarlierMap& earlier) : earlier_(earlier) {}

  /// Whether the optimisation has found the drive's place: loops that agree lead into the earlier keyframes.
  [[nodiscard]] static bool isPlaced(const FrontEndResult& drive, const BackEndResult& optimised);

  struct Tools {
    const FusionInput& input;
    const OccupancyConfig& occupancy;
    const FrontEndConfig& front_end;
    const RevisionConfig& revision;
    const ExplainChanges& explain;  ///< may be empty
  };
  /// Compares the drive with the earlier keyframes, and makes keyframes of the frames that show changes. Frames of sub-maps that
  /// no loop joined to it are left out.
  void revise(FrontEndResult& drive, BackEndResult& optimised, const Tools& tools);

  [[nodiscard]] const GoneSpace& gone() const { return revision_.gone; }
  [[nodiscard]] const std::vector<Change>& changes() const { return revision_.changes.changes; }
  [[nodiscard]] const ChangeExplanation& explanation() const { return explanation_; }
  [[nodiscard]] int witnesses() const { return static_cast<int>(revision_.witnesses.size()); }

  /// Of the earlier frames, moved along with their keyframes.
  [[nodiscard]] recording::Trajectory trajectory(const KeyframeGraph& graph) const;
  [[nodiscard]] recording::Trajectory baseTrajectory(const recording::Trajectory& T_map_camera) const;
  [[nodiscard]] double largestMove_m(const KeyframeGraph& graph) const;

 private:
  [[nodiscard]] std::vector<MovedKeyframe> movedKeyframes(const KeyframeGraph& graph) const;

  const EarlierMap& earlier_;
  Revision revision_;
  ChangeExplanation explanation_;
};

}  // namespace oikos::mapping
