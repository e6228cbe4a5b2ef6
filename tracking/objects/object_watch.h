// SPDX-License-Identifier: Apache-2.0
// Small objects over a recording: each is looked for in a few images that have its place in plain view, as the home is believed to look
// with the doors, drawers and furniture that the recording has been found to show.
#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "semantic/model/home.h"
#include "tracking/objects/believed_scene.h"
#include "tracking/objects/missed_test.h"
#include "tracking/objects/object_config.h"
#include "tracking/objects/object_views.h"

namespace oikos::tracking {

/// Not thread-safe.
class ObjectWatch {
 public:
  /// `frames`: all of the recording that were found, in the order of time; their images are not needed to choose some of them. Throws as
  /// BelievedScene, ContractViolation for a configuration that is not valid.
  ObjectWatch(const semantic::Home& home, const std::filesystem::path& home_folder, const CarrierReadings& readings,
              const std::vector<WatchFrame>& frames, const camera::PinholeCamera& camera, const ObjectWatchConfig& config);

  /// The frames of the recording to be read next, ascending; again and again until there is none.
  [[nodiscard]] std::vector<int> wanted();
  /// One of those, and where it was. `depth_m` is needed.
  void look(const camera::RgbdFrame& frame, const WatchFrame& seen);

  /// Objects that were looked for, in the home's order.
  [[nodiscard]] std::vector<ObjectReading> conclude() const;

 private:
  struct Track {
    std::vector<ObjectCandidate> candidates;
    std::set<int> wanted;  ///< frames
    std::vector<TimedSight> sights;
  };

  void wantFirst(Track& track, std::set<int>& read) const;
  void wantAnother(Track& track, std::set<int>& read) const;

  camera::PinholeCamera camera_;
  ObjectWatchConfig config_;
  BelievedScene scene_;
  std::vector<Track> tracks_;  ///< by object of the scene
  std::set<int> read_;         ///< frames that are read anyway
  bool has_chosen_ = false;
};

}  // namespace oikos::tracking
