// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::semantic {

/// How an object stands to a box that may carry it, both upright: its middle within the box is `in`; above it, its foot not over
/// `kTouch_m` from the top, `on`; below it `under`; beside it nothing.
[[nodiscard]] std::optional<Relation> findRelation(const Box& carrier, const Eigen::Isometry3d& T_carrier_object,
                                                   const std::optional<Box>& object_box);

/// What geometry alone says of two things; the first three can be stored.
enum class SpatialRelation { kOn, kIn, kUnder, kNear };
constexpr auto enumTable(SpatialRelation) {
  return std::to_array<base::EnumName<SpatialRelation>>(
      {{SpatialRelation::kOn, "on"}, {SpatialRelation::kIn, "in"}, {SpatialRelation::kUnder, "under"}, {SpatialRelation::kNear, "near"}});
}

/// To a carrier of several boxes: every relation that one of them gives, in the enum's order; `near` alone if there is none and the
/// object's middle is at most `kNear_m` from one; empty: far off.
[[nodiscard]] std::vector<SpatialRelation> spatialRelations(std::span<const Box> carrier, const Eigen::Isometry3d& T_carrier_object,
                                                            const std::optional<Box>& object_box);

/// From a point to the nearest of a box; 0 within.
[[nodiscard]] double distanceTo(const Box& box, const Eigen::Vector3d& point_carrier);

/// The boxes of what `parent` names (a large object with all its parts, or one part), in that frame.
[[nodiscard]] std::vector<Box> boxesOf(const LargeObject& object, std::string_view parent);

constexpr double kTouch_m = 0.05;
constexpr double kNear_m = 0.5;

}  // namespace oikos::semantic
