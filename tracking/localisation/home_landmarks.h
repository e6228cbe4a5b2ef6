// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "registration/landmark/landmark_scene.h"
#include "semantic/model/home.h"

namespace oikos::tracking {

/// The furniture of a home that is not easily moved (`movability="fixed"`: S220, S223), as it is believed to stand; rooms with an outline
/// have walls that hide what is behind them. `home_folder` is
/// where model files are. Throws Error for a model that cannot be made.
[[nodiscard]] registration::LandmarkScene makeLandmarks(const semantic::Home& home, const std::filesystem::path& home_folder);

/// The landmark with this id. Throws Error{kUsage} that says what it is instead (shiftable, movable, no large object, the nearest id).
[[nodiscard]] int getLandmark(const registration::LandmarkScene& landmarks, const semantic::Home& home, const std::string& id);

}  // namespace oikos::tracking
