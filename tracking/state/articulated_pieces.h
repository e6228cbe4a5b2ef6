// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "registration/articulated/articulated_registration.h"
#include "semantic/model/home.h"

namespace oikos::tracking {

/// A piece of the home with doors, drawers or knobs, as it is believed to stand.
struct ArticulatedPiece {
  semantic::ObjectId id;
  semantic::Movability movability = semantic::Movability::kFixed;
  model::ArticulatedModel model;        ///< joint i is joint i of the object; knobs come behind
  std::vector<semantic::Joint> joints;  ///< the object's
  registration::Standing believed;
  Eigen::AlignedBox3d body_model;   ///< around what no joint moves
  Eigen::AlignedBox3d box_model;    ///< around all of it as it is believed
  Eigen::AlignedBox3d reach_model;  ///< and with its joints anywhere
};

/// Every fixed or shiftable piece with a joint or a knob, in the home's order; of a movable one nobody knows where it stands. `only`: that
/// one alone. `home_folder` is where model files are. Throws Error: for a model that cannot be made; kUsage if `only` is no such piece.
[[nodiscard]] std::vector<ArticulatedPiece> articulatedPieces(const semantic::Home& home, const std::filesystem::path& home_folder,
                                                              const std::string& only = {});

}  // namespace oikos::tracking
