// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/articulated_pieces.h"

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "registration/articulated/joint_tree.h"
#include "semantic/model/home_models.h"
#include "tracking/furniture/changed_pieces.h"

namespace oikos::tracking {

namespace {

bool hasStates(const semantic::LargeObject& object) {
  return object.articulation && !(object.articulation->joints.empty() && object.articulation->knobs.empty());
}

bool isTracked(const semantic::LargeObject& object) {
  return object.movability != semantic::Movability::kMovable && hasStates(object);
}

Eigen::AlignedBox3d bodyBoxOf(model::ArticulatedModel model, const std::vector<double>& joint_values) {
  const registration::JointTree tree(model);
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    if (tree.linkOf(static_cast<int>(part)) != 0) {
      model.parts[part].mesh_part = nullptr;
    }
  }
  return boxOf(model, {joint_values});
}

[[noreturn]] void refuse(const semantic::Home& home, const std::string& only) {
  std::vector<std::string> known;
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (isTracked(object)) {
        known.push_back(object.id.value);
      } else if (object.id.value == only) {
        throw base::Error(base::ErrorCode::kUsage,
                          "'" + only + (hasStates(object) ? "' is movable: it may stand anywhere" : "' has no doors, drawers or knobs"),
                          "--object");
      }
    }
  }
  throw base::Error(base::ErrorCode::kUsage, "no furniture '" + only + "' with doors, drawers or knobs" + base::didYouMean(only, known),
                    "--object");
}

}  // namespace

std::vector<ArticulatedPiece> articulatedPieces(const semantic::Home& home, const std::filesystem::path& home_folder,
                                                const std::string& only) {
  std::vector<ArticulatedPiece> pieces;
  semantic::ModelMaker maker(home_folder);
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (!isTracked(object) || (!only.empty() && object.id.value != only)) {
        continue;
      }
      ArticulatedPiece piece;
      piece.id = object.id;
      piece.movability = object.movability;
      piece.model = maker.make(object);
      piece.joints = object.articulation->joints;
      piece.believed = {object.T_map_object.toIsometry(), semantic::jointValues(object)};
      piece.body_model = bodyBoxOf(piece.model, piece.believed.joint_values);
      piece.box_model = boxOf(piece.model, {piece.believed.joint_values});
      piece.reach_model = reachBoxOf(piece.model, piece.believed.joint_values);
      pieces.push_back(std::move(piece));
    }
  }
  if (pieces.empty() && !only.empty()) {
    refuse(home, only);
  }
  return pieces;
}

}  // namespace oikos::tracking
