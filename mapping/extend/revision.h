// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mapping/change/change_finder.h"
#include "mapping/extend/gone_space.h"
#include "mapping/extend/revision_config.h"
#include "mapping/volume/map_builder.h"

namespace oikos::mapping {

/// A located frame of the drive, to be held against the map.
struct DriveView {
  View view;
  bool is_kept = false;  ///< a keyframe already
};

/// What a drive says about the map that it extends (S21, S222).
struct Revision {
  ChangeResult changes;
  GoneSpace gone;                  ///< all that has gone, with what is beside it and less clear
  std::vector<LocatedScan> scans;  ///< of the drive's views, halved in size
  std::vector<int> witnesses;      ///< frames that show changes and become keyframes for it: the map is what its keyframes show
};

/// Frames about a step apart, and all that are kept already.
[[nodiscard]] std::vector<DriveView> spreadOut(const std::vector<DriveView>& drive, const RevisionConfig& config);

/// Compares the drive's views with the map of the earlier keyframes, both in `map`. Then chooses, the one that shows most first, the views
/// that together show each change from `witnesses` places. The same result for any number of threads.
[[nodiscard]] Revision revise(const std::vector<View>& earlier, const std::vector<DriveView>& drive, const FusionInput& input,
                              const OccupancyConfig& occupancy, const RevisionConfig& config);

}  // namespace oikos::mapping
