// SPDX-License-Identifier: Apache-2.0
// What a recording shows that the home's map does not.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "core/recording/recording.h"
#include "mapping/extend/revision_config.h"
#include "mapping/volume/occupancy_config.h"
#include "tracking/changes/change_boxes.h"
#include "tracking/state/recording_states.h"

namespace oikos::tools {

struct TrackChangesConfig {
  mapping::OccupancyConfig occupancy;  ///< of the map's space
  mapping::RevisionConfig revision;    ///< how the recording's views are held against it

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("occupancy", occupancy);
    visitor("revision", revision);
  }
  [[nodiscard]] std::vector<std::string> validate() const { return {}; }
};

/// The space of a home's map, recalled once for all recordings of a batch, by the first that needs it. Thread-safe.
class ChangeWatch {
 public:
  /// `map`: the folder. What is given outlives it.
  ChangeWatch(std::filesystem::path map, const TrackChangesConfig& config) : map_(std::move(map)), config_(config) {}

  /// `states`: what was read of the recording, with these tools. Throws Error if the home has no map, or none that can be read.
  [[nodiscard]] std::vector<tracking::ChangeBox> find(const recording::Recording& recording, const tracking::RecordingStates& states,
                                                      const tracking::StateTools& tools);

 private:
  std::filesystem::path map_;
  const TrackChangesConfig& config_;
  std::mutex mutex_;
  std::shared_ptr<const mapping::SeenSpace> space_;
};

}  // namespace oikos::tools
