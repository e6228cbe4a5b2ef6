// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "registration/landmark/landmark_scene.h"
#include "semantic/model/home.h"

namespace oikos::tracking {

/// What of a home is a landmark beside the furniture that is not easily moved.
struct LandmarkChoice {
  bool has_shiftable = false;  ///< tables and sofas: while it is fresh where they stand
  bool has_walls = false;      ///< of rooms with an outline, those with fixed furniture at them, each a piece of its own: ROOM/wall-1, …
  std::vector<std::string> without = {};  ///< ids of what is no landmark all the same

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("has_shiftable", has_shiftable);
    visitor("has_walls", has_walls);
  }
};

/// The furniture of a home that is not easily moved (`movability="fixed"`: S220, S223), as it is believed to stand, and what else is
/// chosen; rooms with an outline have walls that hide what is behind them. `home_folder` is where model files are. Throws Error for a model
/// that cannot be made.
[[nodiscard]] registration::LandmarkScene makeLandmarks(const semantic::Home& home, const std::filesystem::path& home_folder,
                                                        const LandmarkChoice& choice = {});

/// The landmark with this id. Throws Error{kUsage} that says what it is instead (shiftable, movable, no large object, the nearest id).
[[nodiscard]] int getLandmark(const registration::LandmarkScene& landmarks, const semantic::Home& home, const std::string& id);

}  // namespace oikos::tracking
