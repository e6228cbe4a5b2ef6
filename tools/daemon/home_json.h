// SPDX-License-Identifier: Apache-2.0
// What the API says of a home's things; metres and degrees, poses as in answers to questions.
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>

#include "semantic/model/home.h"
#include "semantic/query/home_index.h"

namespace oikos::daemon {

using Json = nlohmann::ordered_json;

[[nodiscard]] Json poseJson(const Eigen::Isometry3d& T);
[[nodiscard]] Json roomJson(const semantic::Room& room);
/// Of furniture and small objects, for lists.
[[nodiscard]] Json summaryJson(const semantic::Thing& thing);
/// All that is known of a thing of any kind.
[[nodiscard]] Json thingJson(const semantic::Thing& thing);

}  // namespace oikos::daemon
