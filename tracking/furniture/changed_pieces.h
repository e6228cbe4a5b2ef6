// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "mapping/change/change_finder.h"
#include "semantic/model/home.h"

namespace oikos::tracking {

/// The box along the model's axes around all its parts, with its joints at each of these values (one a joint).
[[nodiscard]] Eigen::AlignedBox3d boxOf(const model::ArticulatedModel& model, const std::vector<std::vector<double>>& joint_values);

/// The same with each joint by itself through its range, the others at `believed`: all that doors and drawers reach.
[[nodiscard]] Eigen::AlignedBox3d reachBoxOf(const model::ArticulatedModel& model, const std::vector<double>& believed);

/// Which piece of furniture a change is of: the smallest whose reach holds most of it, with its doors and drawers anywhere between their
/// limits: a leaf that was opened is no change of what stands about it. One a change; empty: of none that the home knows. Throws Error
/// for a model that cannot be made.
[[nodiscard]] std::vector<std::string> piecesOf(const std::vector<mapping::Change>& changes, const semantic::Home& home,
                                                const std::filesystem::path& home_folder);

}  // namespace oikos::tracking
