// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::semantic {

/// How an object stands to a box that may carry it, both upright: its middle within the box is `in`; above it, its foot not over
/// `kTouch_m` from the top, `on`; below it `under`; beside it nothing.
[[nodiscard]] std::optional<Relation> findRelation(const Box& carrier, const Eigen::Isometry3d& T_carrier_object,
                                                   const std::optional<Box>& object_box);

/// The boxes of what `parent` names (a large object with all its parts, or one part), in that frame.
[[nodiscard]] std::vector<Box> boxesOf(const LargeObject& object, std::string_view parent);

constexpr double kTouch_m = 0.05;

}  // namespace oikos::semantic
