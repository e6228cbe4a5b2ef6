// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/base/error.h"
#include "core/model/furniture/appliances.h"
#include "core/model/furniture/carcass.h"
#include "core/model/furniture/fronts.h"
#include "core/model/primitives.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

namespace {

constexpr double kHob_m = 0.012;
constexpr double kPlateProud_m = 0.002;
constexpr double kRack_m = 0.004;

/// Heights from below.
struct OvenPlan {
  double plinth_top;
  double door_bottom;
  double panel_bottom;
  double panel_top;
  double top;
  double face;
  double body_front;
  Span width;
};

OvenPlan planOven(const OvenShape& shape) {
  const double top = shape.bottom_m + shape.height_m;
  const double panel_top = shape.hob_plate_count > 0 ? top - kHob_m : top;
  const double plinth_top = shape.bottom_m + shape.plinth_height_m;
  const double face = shape.depth_m / 2.0;
  return {.plinth_top = plinth_top,
          .door_bottom = plinth_top + shape.lower_front_height_m,
          .panel_bottom = panel_top - shape.panel_height_m,
          .panel_top = panel_top,
          .top = top,
          .face = face,
          .body_front = face - shape.door_m - kBumper_m,
          .width = {-shape.width_m / 2.0, shape.width_m / 2.0}};
}

HingedFront planDoor(const OvenShape& shape) {
  const OvenPlan plan = planOven(shape);
  const Eigen::AlignedBox3d front = boxOf({plan.face - shape.door_m, plan.face}, plan.width, {plan.door_bottom, plan.panel_bottom});
  return {.name = "door",
          .closed_model = shrunk(front, shape.door_gap_m / 2.0),
          .hinge = HingeEdge::kBottom,
          .opening_rad = shape.door_opening_rad};
}

HandleRule handleRule(const OvenShape& shape) {
  return {.style = shape.handle, .length_m = shape.handle_length_m, .offset_m = shape.handle_offset_m, .level = 0.5};
}

/// A frame of four boards around a pane; the window sits a little low, below the handle.
void addWindowedDoor(FurnitureBuilder& builder, int part, const OvenShape& shape) {
  const Eigen::AlignedBox3d door = planDoor(shape).closed_model;
  const Finish front = {"front", shape.front_rgb};
  if (shape.window_ratio <= 0.0) {
    builder.addBox(part, door, front);
    return;
  }
  const Eigen::Vector3d low = door.min();
  const Eigen::Vector3d high = door.max();
  const double side_m = (1.0 - shape.window_ratio) / 2.0 * (high.y() - low.y());
  const double edge_m = (1.0 - shape.window_ratio) / 2.0 * (high.z() - low.z());
  const Span depth = {low.x(), high.x()};
  const Span y = {low.y() + side_m, high.y() - side_m};
  const Span z = {low.z() + 0.7 * edge_m, high.z() - 1.3 * edge_m};
  builder.addBox(part, boxOf(depth, {low.y(), y.low_m}, {low.z(), high.z()}), front);
  builder.addBox(part, boxOf(depth, {y.high_m, high.y()}, {low.z(), high.z()}), front);
  builder.addBox(part, boxOf(depth, y, {low.z(), z.low_m}), front);
  builder.addBox(part, boxOf(depth, y, {z.high_m, high.z()}), front);
  builder.addBox(part, boxOf({low.x() + 0.2 * shape.door_m, high.x() - 0.1 * shape.door_m}, y, z), {"glass", shape.glass_rgb});
}

void addHob(FurnitureBuilder& builder, const OvenShape& shape) {
  const OvenPlan plan = planOven(shape);
  const double top = plan.top - kPlateProud_m;
  builder.addBox(0, boxOf({-plan.face, plan.face}, plan.width, {plan.panel_top, top}), {"hob", shape.hob_rgb});
  const double radius_m = 0.17 * std::min(shape.width_m, shape.depth_m);
  for (int i = 0; i < shape.hob_plate_count; ++i) {
    const bool is_large = i % 3 == 0;
    const TriangleMesh plate = makeCylinder({.radius_m = static_cast<float>(is_large ? radius_m : 0.8 * radius_m),
                                             .length_m = static_cast<float>(kPlateProud_m),
                                             .segments = 32});
    const bool alone = shape.hob_plate_count == 1;
    const double x = alone ? 0.0 : (i < 2 ? 0.23 : -0.23) * shape.depth_m;
    const double y = alone ? 0.0 : (i % 2 == 0 ? -0.23 : 0.23) * shape.width_m;
    builder.addShape(0, plate, Eigen::Vector3d(x, y, top + kPlateProud_m / 2.0), {"plate", shape.plate_rgb});
  }
}

/// The racks are grids of rods from side to side, with a rail at each end.
void addRacks(FurnitureBuilder& builder, const Eigen::AlignedBox3d& hollow, int count) {
  constexpr int kBars = 7;
  const Finish rack = {"rack", 0x8A8E91};
  for (int i = 1; i <= count; ++i) {
    const double z = hollow.min().z() + hollow.sizes().z() * i / (count + 1);
    const Span height = {z, z + kRack_m};
    for (int bar = 0; bar < kBars; ++bar) {
      const double x = hollow.min().x() + 0.02 + (hollow.sizes().x() - 0.06) * bar / (kBars - 1);
      builder.addBox(0, boxOf({x, x + kRack_m}, {hollow.min().y(), hollow.max().y()}, height), rack);
    }
  }
}

void addBody(FurnitureBuilder& builder, const OvenShape& shape) {
  const OvenPlan plan = planOven(shape);
  const Finish body = {"body", shape.body_rgb};
  const Span depth = {-plan.face, plan.body_front};
  const Span front = {plan.body_front, plan.face};
  addPlinth(builder, boxOf(depth, plan.width, {shape.bottom_m, plan.plinth_top}), 0.02, {"plinth", shape.inside_rgb});
  if (shape.lower_front_height_m > 0.0) {
    const Span height = {plan.plinth_top, plan.door_bottom};
    builder.addBox(0, boxOf(depth, plan.width, height), body);
    builder.addBox(0, boxOf(front, plan.width, height), {"front", shape.front_rgb});
  }
  builder.addBox(0, boxOf(depth, plan.width, {plan.panel_bottom, plan.panel_top}), body);
  builder.addBox(0, boxOf(front, plan.width, {plan.panel_bottom, plan.panel_top}), {"panel", shape.panel_rgb});
  // A shell in the body's colour around the oven's own dark walls.
  const double shell_m = shape.wall_m / 4.0;
  const Eigen::AlignedBox3d shell = boxOf(depth, plan.width, {plan.door_bottom, plan.panel_bottom});
  const Eigen::AlignedBox3d inner =
      addCarcass(builder, {.outer_model = shell, .board_m = shell_m, .back_m = shell_m, .finish = body, .shelf_finish = body});
  const Finish dark = {"inside", shape.inside_rgb};
  const Eigen::AlignedBox3d hollow = addCarcass(
      builder,
      {.outer_model = inner, .board_m = shape.wall_m - shell_m, .back_m = shape.wall_m - shell_m, .finish = dark, .shelf_finish = dark});
  addRacks(builder, hollow, shape.rack_count);
}

}  // namespace

std::vector<std::string> OvenShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("wall_m", wall_m);
  rules.length("door_m", door_m).length("panel_height_m", panel_height_m).length("handle_length_m", handle_length_m);
  rules.length("knob_radius_m", knob_radius_m).between("bottom_m", bottom_m, 0.0, 10.0);
  rules.between("plinth_height_m", plinth_height_m, 0.0, 1.0).between("lower_front_height_m", lower_front_height_m, 0.0, 1.0);
  rules.between("rack_count", rack_count, 0, 6).between("hob_plate_count", hob_plate_count, 0, 4);
  rules.between("door_gap_m", door_gap_m, 0.0, 0.1).angle("door_opening_deg", door_opening_rad, 5.0, 92.0);
  rules.between("window_ratio", window_ratio, 0.0, 0.9).between("handle_offset_m", handle_offset_m, 0.0, 100.0);
  rules.between("knob_count", knob_count, 0, 12).between("knob_state_count", knob_state_count, 2, 100);
  rules.angle("knob_range_deg", knob_range_rad, 5.0, 355.0);
  rules.color("body_rgb", body_rgb).color("front_rgb", front_rgb).color("panel_rgb", panel_rgb).color("inside_rgb", inside_rgb);
  rules.color("glass_rgb", glass_rgb).color("hob_rgb", hob_rgb).color("plate_rgb", plate_rgb).color("handle_rgb", handle_rgb);
  rules.color("knob_rgb", knob_rgb).color("mark_rgb", mark_rgb);
  if (!rules.messages().empty()) {
    return rules.messages();
  }
  const HingedFront door = planDoor(*this);
  rules.require(door.closed_model.sizes().z() > 2.0 * wall_m + (rack_count + 1) * 0.02, "height_m", height_m,
                "must leave the oven room for its walls and racks");
  rules.require(2.0 * wall_m < width_m - 0.1 && wall_m < depth_m - door_m - 0.1, "wall_m", wall_m, "must leave 0.1 m between the walls");
  rules.require(handleFits(door, handleRule(*this)), "handle_length_m", handle_length_m,
                "must fit on the door with handle_offset_m from its edge");
  rules.require(turningRoom(door) <= door_gap_m / 2.0, "door_gap_m", door_gap_m,
                "must let the door turn past the panel: larger, or door_m less");
  rules.require(2.2 * knob_radius_m * knob_count <= width_m && 2.2 * knob_radius_m <= panel_height_m, "knob_radius_m", knob_radius_m,
                "must let all knobs turn on the panel");
  return rules.messages();
}

ArticulatedModel makeOven(const OvenShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("oven");
  addBody(builder, shape);
  if (shape.hob_plate_count > 0) {
    addHob(builder, shape);
  }
  const HingedFront door = planDoor(shape);
  const int part = builder.addHingedPart(door);
  addWindowedDoor(builder, part, shape);
  builder.addHandle(part, placeHandle(door, handleRule(shape)), {"handle", shape.handle_rgb});
  const OvenPlan plan = planOven(shape);
  for (int i = 0; i < shape.knob_count; ++i) {
    const double y = plan.width.low_m + shape.width_m * (i + 0.5) / shape.knob_count;
    builder.addKnob({.name = "knob_" + std::to_string(i),
                     .centre_model = Eigen::Vector3d(plan.face, y, (plan.panel_bottom + plan.panel_top) / 2.0),
                     .radius_m = shape.knob_radius_m,
                     .state_count = shape.knob_state_count,
                     .range_rad = shape.knob_range_rad},
                    {"knob", shape.knob_rgb}, {"mark", shape.mark_rgb});
  }
  return builder.build();
}

}  // namespace oikos::model
