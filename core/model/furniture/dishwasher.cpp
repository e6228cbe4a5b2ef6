// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/base/error.h"
#include "core/model/furniture/appliances.h"
#include "core/model/furniture/carcass.h"
#include "core/model/furniture/fronts.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

namespace {

constexpr double kWire_m = 0.004;
constexpr double kBasketPlay_m = 0.01;

struct DishwasherPlan {
  Eigen::AlignedBox3d plinth;
  Eigen::AlignedBox3d carcass;
  HingedFront door;
};

DishwasherPlan planDishwasher(const DishwasherShape& shape) {
  const double face = shape.depth_m / 2.0;
  const Span depth = {-face, face - shape.door_m - kBumper_m};
  const Span width = {-shape.width_m / 2.0, shape.width_m / 2.0};
  const Span height = {shape.plinth_height_m, shape.height_m};
  const Eigen::AlignedBox3d front = boxOf({face - shape.door_m, face}, width, height);
  return {.plinth = boxOf(depth, width, {0.0, shape.plinth_height_m}),
          .carcass = boxOf(depth, width, height),
          .door = {.name = "door",
                   .closed_model = shrunk(front, shape.door_gap_m / 2.0),
                   .hinge = HingeEdge::kBottom,
                   .opening_rad = shape.door_opening_rad}};
}

HandleRule handleRule(const DishwasherShape& shape) {
  return {.style = shape.handle, .length_m = shape.handle_length_m, .offset_m = shape.handle_offset_m, .level = 0.5};
}

/// All above the open door, which lies as thick as it is on the body's lower edge.
std::vector<Eigen::AlignedBox3d> planBaskets(const DishwasherShape& shape) {
  const DishwasherPlan plan = planDishwasher(shape);
  const Eigen::Vector3d wall = Eigen::Vector3d::Constant(shape.wall_m + kBasketPlay_m);
  const Eigen::Vector3d low = plan.carcass.min() + wall + Eigen::Vector3d(0.0, 0.0, shape.door_m);
  const Eigen::Vector3d high = plan.carcass.max() - wall;
  const double pitch_m = (high.z() - low.z()) / std::max(1, shape.basket_count);
  std::vector<Eigen::AlignedBox3d> baskets;
  for (int i = 0; i < shape.basket_count; ++i) {
    const double bottom = low.z() + i * pitch_m;
    baskets.push_back(boxOf({low.x(), high.x()}, {low.y(), high.y()}, {bottom, bottom + 0.4 * pitch_m}));
  }
  return baskets;
}

/// A rim and a foot of wire, posts between them, and bars across the floor.
void addBasket(FurnitureBuilder& builder, int part, const Eigen::AlignedBox3d& basket, const Finish& finish) {
  constexpr int kBars = 6;
  const Eigen::Vector3d low = basket.min();
  const Eigen::Vector3d high = basket.max();
  const Span inner_width = {low.y() + kWire_m, high.y() - kWire_m};
  for (const double z : {low.z(), high.z() - kWire_m}) {
    const Span height = {z, z + kWire_m};
    builder.addBox(part, boxOf({low.x(), high.x()}, {low.y(), inner_width.low_m}, height), finish);
    builder.addBox(part, boxOf({low.x(), high.x()}, {inner_width.high_m, high.y()}, height), finish);
    builder.addBox(part, boxOf({low.x(), low.x() + kWire_m}, inner_width, height), finish);
    builder.addBox(part, boxOf({high.x() - kWire_m, high.x()}, inner_width, height), finish);
  }
  const Span between = {low.z() + kWire_m, high.z() - kWire_m};
  for (int i = 0; i < kBars; ++i) {
    const double x = low.x() + (high.x() - low.x() - kWire_m) * i / (kBars - 1);
    const double y = low.y() + (high.y() - low.y() - kWire_m) * i / (kBars - 1);
    builder.addBox(part, boxOf({x, x + kWire_m}, {low.y(), low.y() + kWire_m}, between), finish);
    builder.addBox(part, boxOf({x, x + kWire_m}, {high.y() - kWire_m, high.y()}, between), finish);
    if (i > 0 && i + 1 < kBars) {
      builder.addBox(part, boxOf({low.x(), low.x() + kWire_m}, {y, y + kWire_m}, between), finish);
      builder.addBox(part, boxOf({high.x() - kWire_m, high.x()}, {y, y + kWire_m}, between), finish);
      builder.addBox(part, boxOf({low.x() + kWire_m, high.x() - kWire_m}, {y, y + kWire_m}, {low.z(), low.z() + kWire_m}), finish);
    }
  }
}

}  // namespace

std::vector<std::string> DishwasherShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("wall_m", wall_m);
  rules.length("door_m", door_m).length("handle_length_m", handle_length_m);
  rules.between("plinth_height_m", plinth_height_m, 0.0, 1.0).between("panel_height_m", panel_height_m, 0.0, 1.0);
  rules.between("basket_count", basket_count, 0, 4).between("basket_ratio", basket_ratio, 0.05, 1.0);
  rules.between("door_gap_m", door_gap_m, 0.0, 0.1).angle("door_opening_deg", door_opening_rad, 5.0, 92.0);
  rules.between("handle_offset_m", handle_offset_m, 0.0, 100.0);
  rules.color("body_rgb", body_rgb).color("front_rgb", front_rgb).color("panel_rgb", panel_rgb).color("handle_rgb", handle_rgb);
  rules.color("basket_rgb", basket_rgb).color("plinth_rgb", plinth_rgb);
  if (!rules.messages().empty()) {
    return rules.messages();
  }
  const DishwasherPlan plan = planDishwasher(*this);
  const Eigen::Vector3d room = plan.carcass.sizes() - Eigen::Vector3d::Constant(2.0 * (wall_m + kBasketPlay_m) + door_m);
  rules.require(room.minCoeff() > 0.1, "height_m", height_m, "must leave 0.1 m between the walls, as must width_m and depth_m");
  rules.require(panel_height_m < plan.door.closed_model.sizes().z(), "panel_height_m", panel_height_m, "must be less than the door");
  rules.require(handleFits(plan.door, handleRule(*this)), "handle_length_m", handle_length_m,
                "must fit on the door with handle_offset_m from its edge");
  return rules.messages();
}

ArticulatedModel makeDishwasher(const DishwasherShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("dishwasher");
  const DishwasherPlan plan = planDishwasher(shape);
  const Finish body = {"body", shape.body_rgb};
  addPlinth(builder, plan.plinth, 0.02, {"plinth", shape.plinth_rgb});
  addCarcass(builder, {.outer_model = plan.carcass, .board_m = shape.wall_m, .back_m = shape.wall_m, .finish = body, .shelf_finish = body});
  const int part = builder.addHingedPart(plan.door);
  Eigen::AlignedBox3d front = plan.door.closed_model;
  Eigen::AlignedBox3d panel = front;
  front.max().z() -= shape.panel_height_m;
  panel.min().z() = front.max().z();
  builder.addBox(part, front, {"front", shape.front_rgb});
  if (shape.panel_height_m > 0.0) {
    builder.addBox(part, panel, {"panel", shape.panel_rgb});
  }
  builder.addHandle(part, placeHandle(plan.door, handleRule(shape)), {"handle", shape.handle_rgb});
  int number = 0;
  for (const Eigen::AlignedBox3d& basket : planBaskets(shape)) {
    const Eigen::Vector3d middle = basket.center();
    const int slide =
        builder.addSlidingPart("basket_" + std::to_string(number++), Eigen::Vector3d(basket.max().x(), middle.y(), middle.z()),
                               shape.basket_ratio * basket.sizes().x());
    addBasket(builder, slide, basket, {"basket", shape.basket_rgb});
  }
  return builder.build();
}

}  // namespace oikos::model
