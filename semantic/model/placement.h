// SPDX-License-Identifier: Apache-2.0
// Where everything is in `map`: furniture from its pose, parts through their joints, small objects through what carries them.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>

#include "semantic/model/home.h"

namespace oikos::semantic {

/// How far the joint has moved its child: T_joint_child at its value.
[[nodiscard]] Eigen::Isometry3d jointMotion(const Joint& joint);

/// The part in its object, through all joints between; nothing if there is no such part or its joints lead round in a circle. A part that
/// no joint moves is fixed to its parent.
[[nodiscard]] std::optional<Eigen::Isometry3d> findPartInObject(const Articulation& articulation, const PartId& part);

/// What `parent` names, in map: the object itself or one of its parts; nothing if it is neither.
[[nodiscard]] std::optional<Eigen::Isometry3d> findCarrierInMap(const LargeObject& object, std::string_view parent);

}  // namespace oikos::semantic
