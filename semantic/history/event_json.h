// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "semantic/history/event.h"

namespace oikos::semantic {

/// {"number", "time", "recording", "frame", "subject", "kind", "before", "after", "confidence", "evidence"}; what is not known is left out.
/// Metres and degrees, times RFC 3339.
[[nodiscard]] nlohmann::ordered_json toJson(const Event& event);
/// {"parent", "relation", "pose": [x, y, z, roll, pitch, yaw]}, {"pose": […]}, {"value_deg": d}, {"value_m": d} or {"setting": name}.
[[nodiscard]] nlohmann::ordered_json toJson(const State& state);

/// The state as it comes back from its JSON: some angles have no text in degrees that gives the same bits.
[[nodiscard]] State asStored(const State& state);

/// Throws Error{kInput} that names the key, what was found and what would be right; `where` is put in front. An unknown key is an error.
[[nodiscard]] Event eventFromJson(const nlohmann::json& json, const std::string& where);
[[nodiscard]] State stateFromJson(const nlohmann::json& json, const std::string& where);
/// {"pose_map": [x, y, z, roll, pitch, yaw]}: where something was observed, whose place in the home is still to be found. Throws as above.
[[nodiscard]] Pose mapPoseFromJson(const nlohmann::json& json, const std::string& where);

}  // namespace oikos::semantic
