// SPDX-License-Identifier: Apache-2.0
// One true home of which some small objects have gone, looked for in drives past all that carries something.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "semantic/model/home.h"
#include "tracking/objects/object_watch.h"

namespace oikos::bench {

struct MissedOptions {
  int scenes = 8;  ///< true homes
  int views = 5;
  double belief_mm = 5.0;
  double pose_mm = 6.0;
  double pose_deg = 0.25;
  std::string sensor = "kinect1";
  unsigned seed = 1;
};

/// One object in one drive.
struct ObjectTrial {
  std::string carrier;  ///< that the drive leads past
  std::string id;
  bool is_gone = false;
  bool is_in_view = false;                         ///< in two images from places apart: 150 pixels, half of it, all of it in the picture
  bool is_measured = false;                        ///< in two of these half of its pixels have a reading
  std::optional<tracking::ObjectReading> reading;  ///< nothing: it was not looked for
};

struct SceneTrials {
  std::vector<ObjectTrial> objects;  ///< that were looked for or, having gone, in view
  int drives = 0;
  double looking_s = 0.0;  ///< processor time in ObjectWatch
};

/// `home`: as it is believed; in truth it differs by `options`. The same for the same seed. Throws Error for models that cannot be made.
[[nodiscard]] SceneTrials runScene(const semantic::Home& home, const MissedOptions& options, const tracking::ObjectWatchConfig& config,
                                   std::uint64_t seed);

}  // namespace oikos::bench
