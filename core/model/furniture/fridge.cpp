// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/model/furniture/appliances.h"
#include "core/model/furniture/carcass.h"
#include "core/model/furniture/fronts.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

namespace {

constexpr double kGlassShelf_m = 0.006;

struct Compartment {
  std::string door_name;
  Eigen::AlignedBox3d carcass;
  HingedFront front;
  int shelf_count;
  double handle_level;
};

Compartment planCompartment(const FridgeShape& shape, const std::string& door_name, const Span& height) {
  const double face = shape.depth_m / 2.0;
  const Span width = {-shape.width_m / 2.0, shape.width_m / 2.0};
  const Eigen::AlignedBox3d front = boxOf({face - shape.door_m, face}, width, height);
  return {.door_name = door_name,
          .carcass = boxOf({-face, face - shape.door_m - kBumper_m}, width, height),
          .front = {.name = door_name,
                    .closed_model = shrunk(front, shape.door_gap_m / 2.0),
                    .hinge = shape.hinge,
                    .opening_rad = shape.door_opening_rad},
          .shelf_count = shape.shelf_count,
          .handle_level = 0.5};
}

/// The handles of two doors lie to both sides of the seam between them.
std::vector<Compartment> planCompartments(const FridgeShape& shape) {
  const double low = shape.plinth_height_m;
  const double high = shape.height_m;
  if (shape.freezer == FreezerPlace::kNone) {
    return {planCompartment(shape, "door", {low, high})};
  }
  const bool below = shape.freezer == FreezerPlace::kBelow;
  const double seam = below ? low + shape.freezer_height_m : high - shape.freezer_height_m;
  Compartment lower = planCompartment(shape, below ? "freezer_door" : "door", {low, seam});
  Compartment upper = planCompartment(shape, below ? "door" : "freezer_door", {seam, high});
  lower.handle_level = 1.0;
  upper.handle_level = 0.0;
  (below ? lower : upper).shelf_count = shape.shelf_count > 0 ? 1 : 0;
  return {lower, upper};
}

HandleRule handleRule(const FridgeShape& shape, const Compartment& compartment) {
  return {.style = shape.handle, .length_m = shape.handle_length_m, .offset_m = shape.handle_offset_m, .level = compartment.handle_level};
}

}  // namespace

std::vector<std::string> FridgeShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("wall_m", wall_m);
  rules.length("door_m", door_m).length("handle_length_m", handle_length_m);
  rules.between("plinth_height_m", plinth_height_m, 0.0, 1.0).between("shelf_count", shelf_count, 0, 30);
  rules.between("door_gap_m", door_gap_m, 0.0, 0.1).angle("door_opening_deg", door_opening_rad, 5.0, 183.0);
  rules.between("handle_offset_m", handle_offset_m, 0.0, 100.0);
  rules.require(hinge == HingeEdge::kLeft || hinge == HingeEdge::kRight, "hinge", hinge, "must be left or right");
  rules.color("body_rgb", body_rgb).color("front_rgb", front_rgb).color("handle_rgb", handle_rgb);
  rules.color("shelf_rgb", shelf_rgb).color("plinth_rgb", plinth_rgb);
  if (!rules.messages().empty()) {
    return rules.messages();
  }
  for (const Compartment& compartment : planCompartments(*this)) {
    const Eigen::Vector3d room = compartment.carcass.sizes() - Eigen::Vector3d(2.0, 2.0, 2.0) * wall_m;
    const double shelves_m = compartment.shelf_count * kGlassShelf_m;
    const char* size = freezer == FreezerPlace::kNone ? "height_m" : "freezer_height_m";
    rules.require(room.z() > shelves_m, size, freezer == FreezerPlace::kNone ? height_m : freezer_height_m,
                  "must leave room behind each door between the walls");
    rules.require(room.head<2>().minCoeff() > 0.0, "wall_m", wall_m, "must leave room between the walls");
    rules.require(handleFits(compartment.front, handleRule(*this, compartment)), "handle_length_m", handle_length_m,
                  "must fit on each door with handle_offset_m from its edge");
  }
  return rules.messages();
}

ArticulatedModel makeFridge(const FridgeShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("fridge");
  const std::vector<Compartment> compartments = planCompartments(shape);
  Eigen::AlignedBox3d plinth = compartments.front().carcass;
  plinth.max().z() = plinth.min().z();
  plinth.min().z() = 0.0;
  addPlinth(builder, plinth, 0.02, {"plinth", shape.plinth_rgb});
  for (const Compartment& compartment : compartments) {
    addCarcass(builder, {.outer_model = compartment.carcass,
                         .board_m = shape.wall_m,
                         .back_m = shape.wall_m,
                         .shelf_count = compartment.shelf_count,
                         .shelf_m = kGlassShelf_m,
                         .shelf_set_back_m = 0.05,
                         .finish = {"body", shape.body_rgb},
                         .shelf_finish = {"shelf", shape.shelf_rgb}});
    addBoardDoor(builder, compartment.front, handleRule(shape, compartment), {"front", shape.front_rgb}, {"handle", shape.handle_rgb});
  }
  return builder.build();
}

}  // namespace oikos::model
