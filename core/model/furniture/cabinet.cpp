// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/cabinet.h"

#include <algorithm>
#include <numbers>

#include "core/base/error.h"
#include "core/model/furniture/carcass.h"
#include "core/model/furniture/fronts.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

namespace {

/// Floor to worktop: what stands on what.
struct CabinetPlan {
  Eigen::AlignedBox3d plinth;
  Eigen::AlignedBox3d carcass;
  Eigen::AlignedBox3d worktop;
  Eigen::AlignedBox3d front;  ///< all of it that the doors share
};

template <class Shape>
CabinetPlan planCabinet(const Shape& shape) {
  const double back = -shape.depth_m / 2.0;
  const double face = shape.depth_m / 2.0;
  const bool has_front = [&] {
    if constexpr (requires { shape.door_count; }) {
      return shape.door_count > 0;
    } else {
      return true;
    }
  }();
  const double carcass_front = has_front ? face - shape.board_m - kBumper_m : face;
  const Span width = {-shape.width_m / 2.0, shape.width_m / 2.0};
  const double carcass_bottom = shape.bottom_m + shape.plinth_height_m;
  const double top = shape.bottom_m + shape.height_m;
  const double carcass_top = top - shape.worktop_thickness_m;
  return {.plinth = boxOf({back, carcass_front}, width, {shape.bottom_m, carcass_bottom}),
          .carcass = boxOf({back, carcass_front}, width, {carcass_bottom, carcass_top}),
          .worktop = boxOf({back, face + shape.worktop_overhang_m}, width, {carcass_top, top}),
          .front = boxOf({face - shape.board_m, face}, width, {carcass_bottom, carcass_top})};
}

template <class Shape>
Eigen::AlignedBox3d addBody(FurnitureBuilder& builder, const Shape& shape, int shelf_count) {
  const CabinetPlan plan = planCabinet(shape);
  const Finish body = {"body", shape.body_rgb};
  addPlinth(builder, plan.plinth, shape.board_m, {"plinth", shape.plinth_rgb});
  if (shape.worktop_thickness_m > 0.0) {
    builder.addBox(0, plan.worktop, {"worktop", shape.worktop_rgb});
  }
  return addCarcass(builder, {.outer_model = plan.carcass,
                              .board_m = shape.board_m,
                              .back_m = shape.back_m,
                              .shelf_count = shelf_count,
                              .shelf_m = shape.board_m,
                              .finish = body,
                              .shelf_finish = body});
}

template <class Shape>
void checkBody(ShapeRules& rules, const Shape& shape) {
  rules.length("width_m", shape.width_m).length("depth_m", shape.depth_m).length("height_m", shape.height_m);
  rules.length("board_m", shape.board_m).length("back_m", shape.back_m);
  rules.between("bottom_m", shape.bottom_m, 0.0, 10.0);
  rules.between("plinth_height_m", shape.plinth_height_m, 0.0, 10.0);
  rules.between("worktop_thickness_m", shape.worktop_thickness_m, 0.0, 1.0);
  rules.between("worktop_overhang_m", shape.worktop_overhang_m, 0.0, 1.0);
  rules.require(!(2.0 * shape.board_m >= shape.width_m), "board_m", shape.board_m,
                "must leave room between the sides: less than width_m / 2");
  rules.require(!(2.0 * shape.board_m + shape.plinth_height_m + shape.worktop_thickness_m >= shape.height_m), "height_m", shape.height_m,
                "must be more than the plinth, two boards and the worktop");
  rules.require(!(shape.back_m + 3.0 * shape.board_m + kBumper_m >= shape.depth_m), "depth_m", shape.depth_m,
                "must be more than the back and three boards");
  rules.color("body_rgb", shape.body_rgb).color("front_rgb", shape.front_rgb).color("handle_rgb", shape.handle_rgb);
  rules.color("plinth_rgb", shape.plinth_rgb).color("worktop_rgb", shape.worktop_rgb);
}

std::vector<HingedFront> planDoors(const CabinetShape& shape) {
  const Eigen::AlignedBox3d front = shrunk(planCabinet(shape).front, shape.door_gap_m / 2.0);
  if (shape.door_count == 1) {
    const bool falls = shape.hinge == HingeEdge::kBottom;
    const double opening_rad = falls ? std::min(shape.door_opening_rad, std::numbers::pi / 2.0) : shape.door_opening_rad;
    return {{.name = "door", .closed_model = front, .hinge = shape.hinge, .opening_rad = opening_rad}};
  }
  if (shape.door_count == 0) {
    return {};
  }
  HingedFront left = {.name = "left_door", .closed_model = front, .hinge = HingeEdge::kLeft, .opening_rad = shape.door_opening_rad};
  HingedFront right = {.name = "right_door", .closed_model = front, .hinge = HingeEdge::kRight, .opening_rad = shape.door_opening_rad};
  left.closed_model.max().y() = -shape.door_gap_m / 2.0;
  right.closed_model.min().y() = shape.door_gap_m / 2.0;
  return {left, right};
}

HandleRule handleRule(const CabinetShape& shape) {
  return {.style = shape.handle, .length_m = shape.handle_length_m, .offset_m = shape.handle_offset_m, .level = shape.handle_level};
}

struct DrawerPlan {
  Eigen::AlignedBox3d front;
  Eigen::AlignedBox3d box;
};

constexpr double kDrawerBoard_m = 0.012;
constexpr double kDrawerRearPlay_m = 0.01;
constexpr double kDrawerHeadroom_m = 0.02;

std::vector<DrawerPlan> planDrawers(const DrawerUnitShape& shape) {
  const CabinetPlan plan = planCabinet(shape);
  const Eigen::Vector3d hollow_low = plan.carcass.min() + Eigen::Vector3d(shape.back_m, shape.board_m, shape.board_m);
  const Eigen::Vector3d hollow_high = plan.carcass.max() - Eigen::Vector3d(0.0, shape.board_m, shape.board_m);
  std::vector<double> heights = shape.front_heights_m;
  heights.resize(static_cast<std::size_t>(shape.drawer_count), 1.0);
  double sum = 0.0;
  for (const double height : heights) {
    sum += height;
  }
  std::vector<DrawerPlan> drawers;
  double top = plan.front.max().z();
  for (const double height : heights) {
    Eigen::AlignedBox3d area = plan.front;
    area.max().z() = top;
    top -= height / sum * plan.front.sizes().z();
    area.min().z() = top;
    const Eigen::AlignedBox3d front = shrunk(area, shape.drawer_gap_m / 2.0);
    const Span depth = {hollow_low.x() + kDrawerRearPlay_m, front.min().x()};
    const Span width = {hollow_low.y() + shape.side_play_m, hollow_high.y() - shape.side_play_m};
    const Span inside = {std::max(front.min().z(), hollow_low.z()) + 0.005, std::min(front.max().z(), hollow_high.z()) - kDrawerHeadroom_m};
    drawers.push_back({front, boxOf(depth, width, inside)});
  }
  return drawers;
}

/// Four boards and a bottom; its front board is the drawer's front.
void addDrawerBox(FurnitureBuilder& builder, int part, const Eigen::AlignedBox3d& box, const Finish& finish) {
  const Eigen::Vector3d low = box.min();
  const Eigen::Vector3d high = box.max();
  const double board_m = kDrawerBoard_m;
  const Span depth = {low.x(), high.x()};
  const Span height = {low.z(), high.z()};
  const Span inner_width = {low.y() + board_m, high.y() - board_m};
  builder.addBox(part, boxOf(depth, {low.y(), low.y() + board_m}, height), finish);
  builder.addBox(part, boxOf(depth, {high.y() - board_m, high.y()}, height), finish);
  builder.addBox(part, boxOf({low.x(), low.x() + board_m}, inner_width, height), finish);
  builder.addBox(part, boxOf({low.x() + board_m, high.x()}, inner_width, {low.z(), low.z() + board_m}), finish);
}

}  // namespace

std::vector<std::string> CabinetShape::validate() const {
  ShapeRules rules("furniture");
  checkBody(rules, *this);
  rules.between("shelf_count", shelf_count, 0, 50).between("door_count", door_count, 0, 2);
  rules.between("door_gap_m", door_gap_m, 0.0, 0.1).angle("door_opening_deg", door_opening_rad, 5.0, 183.0);
  rules.length("handle_length_m", handle_length_m).between("handle_level", handle_level, 0.0, 1.0);
  rules.between("handle_offset_m", handle_offset_m, 0.0, 100.0);
  if (!rules.messages().empty()) {
    return rules.messages();  // what follows needs sizes that make sense
  }
  const double inner_m = height_m - plinth_height_m - worktop_thickness_m - (2 + shelf_count) * board_m;
  const bool under_overhang = door_count == 1 && hinge == HingeEdge::kTop && worktop_thickness_m > 0.0;
  rules.require(!under_overhang || worktop_overhang_m == 0.0, "worktop_overhang_m", worktop_overhang_m,
                "must be 0 above a door that is hinged at its top");
  rules.require(inner_m > 0.0, "shelf_count", shelf_count, "must leave room between the shelves");
  for (const HingedFront& front : planDoors(*this)) {
    rules.require(front.closed_model.sizes().minCoeff() > 0.0, "door_gap_m", door_gap_m, "must leave something of the doors");
    rules.require(handleFits(front, handleRule(*this)), "handle_length_m", handle_length_m,
                  "must fit on the door with handle_offset_m from its edge");
    rules.require(door_count < 2 || turningRoom(front) <= door_gap_m, "door_gap_m", door_gap_m,
                  "must let a door turn past the other: larger, or board_m less");
    const bool rises = front.hinge == HingeEdge::kBottom && worktop_thickness_m > 0.0 && worktop_overhang_m > 0.0;
    rules.require(!rises || turningRoom(front) <= door_gap_m / 2.0, "door_gap_m", door_gap_m,
                  "must let the door turn past the worktop: larger, or board_m less");
  }
  return rules.messages();
}

ArticulatedModel makeCabinet(const CabinetShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("cabinet");
  addBody(builder, shape, shape.shelf_count);
  for (const HingedFront& front : planDoors(shape)) {
    addBoardDoor(builder, front, handleRule(shape), {"front", shape.front_rgb}, {"handle", shape.handle_rgb});
  }
  return builder.build();
}

std::vector<std::string> DrawerUnitShape::validate() const {
  ShapeRules rules("furniture");
  checkBody(rules, *this);
  rules.between("drawer_count", drawer_count, 1, 20).between("drawer_gap_m", drawer_gap_m, 0.0, 0.1);
  rules.between("side_play_m", side_play_m, 0.0, 0.1).between("extension_ratio", extension_ratio, 0.05, 1.0);
  rules.length("handle_length_m", handle_length_m).color("drawer_rgb", drawer_rgb);
  const auto named = static_cast<int>(front_heights_m.size());
  rules.require(named == 0 || named == drawer_count, "front_heights_m", named, "must be none, or as many as drawer_count");
  for (const double height : front_heights_m) {
    rules.length("front_heights_m", height);
  }
  if (!rules.messages().empty()) {
    return rules.messages();
  }
  rules.require(handle == HandleStyle::kNone || handle == HandleStyle::kKnob || handle_length_m <= width_m - 0.02, "handle_length_m",
                handle_length_m, "must fit on the front");
  for (const DrawerPlan& drawer : planDrawers(*this)) {
    const Eigen::Vector3d room = drawer.box.sizes() - Eigen::Vector3d::Constant(2.0 * kDrawerBoard_m);
    rules.require(room.minCoeff() > 0.0, "drawer_count", drawer_count, "must leave each drawer a box of more than its boards");
    rules.require(handle != HandleStyle::kBarVertical || handle_length_m <= drawer.front.sizes().z(), "handle_length_m", handle_length_m,
                  "must fit on the lowest front");
  }
  return rules.messages();
}

ArticulatedModel makeDrawerUnit(const DrawerUnitShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("drawer_unit");
  addBody(builder, shape, 0);
  int number = 0;
  for (const auto& [front, box] : planDrawers(shape)) {
    const std::string name = "drawer_" + std::to_string(number++);
    const Eigen::Vector3d face = {front.max().x(), front.center().y(), front.center().z()};
    const int part = builder.addSlidingPart(name, face, shape.extension_ratio * box.sizes().x());
    builder.addBox(part, front, {"front", shape.front_rgb});
    addDrawerBox(builder, part, box, {"drawer", shape.drawer_rgb});
    builder.addHandle(part, {.name = name + "_handle", .style = shape.handle, .centre_model = face, .length_m = shape.handle_length_m},
                      {"handle", shape.handle_rgb});
  }
  return builder.build();
}

}  // namespace oikos::model
