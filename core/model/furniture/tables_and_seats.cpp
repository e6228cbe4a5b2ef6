// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/base/error.h"
#include "core/model/furniture/builder.h"
#include "core/model/furniture/living.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

namespace {

/// Legs in the corners of a box, from its lower to its upper face.
void addLegs(FurnitureBuilder& builder, const Eigen::AlignedBox3d& corners, double leg_m, const Finish& finish) {
  const Eigen::Vector3d low = corners.min();
  const Eigen::Vector3d high = corners.max();
  for (const double x : {low.x(), high.x() - leg_m}) {
    for (const double y : {low.y(), high.y() - leg_m}) {
      builder.addBox(0, boxOf({x, x + leg_m}, {y, y + leg_m}, {low.z(), high.z()}), finish);
    }
  }
}

/// Boards from leg to leg along the sides of a box, as thick as half a leg.
void addApron(FurnitureBuilder& builder, const Eigen::AlignedBox3d& sides, double leg_m, const Finish& finish) {
  const Eigen::Vector3d low = sides.min();
  const Eigen::Vector3d high = sides.max();
  const Span height = {low.z(), high.z()};
  const double inset_m = leg_m / 4.0;
  for (const double x : {low.x() + inset_m, high.x() - 3.0 * inset_m}) {
    builder.addBox(0, boxOf({x, x + 2.0 * inset_m}, {low.y() + leg_m, high.y() - leg_m}, height), finish);
  }
  for (const double y : {low.y() + inset_m, high.y() - 3.0 * inset_m}) {
    builder.addBox(0, boxOf({low.x() + leg_m, high.x() - leg_m}, {y, y + 2.0 * inset_m}, height), finish);
  }
}

}  // namespace

std::vector<std::string> TableShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("top_m", top_m).length("leg_m", leg_m);
  rules.between("leg_inset_m", leg_inset_m, 0.0, 10.0).between("apron_height_m", apron_height_m, 0.0, 10.0);
  rules.require(!(2.0 * (leg_m + leg_inset_m) >= std::min(width_m, depth_m)), "leg_m", leg_m, "must leave room between the legs");
  rules.require(!(top_m + apron_height_m >= height_m), "height_m", height_m, "must be more than the top and the apron");
  rules.color("top_rgb", top_rgb).color("leg_rgb", leg_rgb);
  return rules.messages();
}

ArticulatedModel makeTable(const TableShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("table");
  const Eigen::Vector3d half(shape.depth_m / 2.0, shape.width_m / 2.0, 0.0);
  const double under = shape.height_m - shape.top_m;
  builder.addBox(0, boxOf({-half.x(), half.x()}, {-half.y(), half.y()}, {under, shape.height_m}), {"top", shape.top_rgb});
  const Eigen::Vector2d legs = half.head<2>().array() - shape.leg_inset_m;
  Eigen::AlignedBox3d corners = boxOf({-legs.x(), legs.x()}, {-legs.y(), legs.y()}, {0.0, under});
  const Finish finish = {"leg", shape.leg_rgb};
  addLegs(builder, corners, shape.leg_m, finish);
  if (shape.apron_height_m > 0.0) {
    corners.min().z() = under - shape.apron_height_m;
    addApron(builder, corners, shape.leg_m, finish);
  }
  return builder.build();
}

std::vector<std::string> ChairShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("seat_height_m", seat_height_m);
  rules.length("seat_m", seat_m).length("leg_m", leg_m).length("back_board_m", back_board_m);
  rules.between("back_board_count", back_board_count, 1, 10);
  rules.require(!(seat_height_m >= height_m), "seat_height_m", seat_height_m, "must be less than height_m");
  rules.require(!(seat_m >= seat_height_m), "seat_m", seat_m, "must be less than seat_height_m");
  rules.require(!(2.0 * leg_m >= std::min(width_m, depth_m)), "leg_m", leg_m, "must leave room between the legs");
  rules.require(!(back_board_m > leg_m), "back_board_m", back_board_m, "must be at most leg_m");
  rules.color("seat_rgb", seat_rgb).color("leg_rgb", leg_rgb);
  return rules.messages();
}

ArticulatedModel makeChair(const ChairShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("chair");
  const double back = -shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const double under = shape.seat_height_m - shape.seat_m;
  const Finish leg = {"leg", shape.leg_rgb};
  const Finish seat = {"seat", shape.seat_rgb};
  addLegs(builder, boxOf({back, -back}, {-side, side}, {0.0, under}), shape.leg_m, leg);
  builder.addBox(0, boxOf({back, -back}, {-side, side}, {under, shape.seat_height_m}), seat);
  addApron(builder, boxOf({back, -back}, {-side, side}, {0.85 * under, under}), shape.leg_m, leg);
  const Span post_height = {shape.seat_height_m, shape.height_m};
  for (const double y : {-side, side - shape.leg_m}) {
    builder.addBox(0, boxOf({back, back + shape.leg_m}, {y, y + shape.leg_m}, post_height), leg);
  }
  // The boards share the upper two thirds of the back, with gaps of half a board between them.
  const double room_m = 0.67 * (shape.height_m - shape.seat_height_m);
  const double board_m = room_m / (1.5 * shape.back_board_count - 0.5);
  const double set_back = back + (shape.leg_m - shape.back_board_m) / 2.0;
  for (int i = 0; i < shape.back_board_count; ++i) {
    const double top = shape.height_m - 0.01 * room_m - 1.5 * board_m * i;
    builder.addBox(0, boxOf({set_back, set_back + shape.back_board_m}, {-side + shape.leg_m, side - shape.leg_m}, {top - board_m, top}),
                   seat);
  }
  return builder.build();
}

std::vector<std::string> SofaShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("seat_height_m", seat_height_m);
  rules.length("arm_width_m", arm_width_m).length("arm_height_m", arm_height_m).length("back_m", back_m).length("foot_m", foot_m);
  rules.between("seat_count", seat_count, 1, 10);
  rules.require(!(2.0 * arm_width_m >= width_m), "arm_width_m", arm_width_m, "must leave room for the seats");
  rules.require(!(back_m >= depth_m), "back_m", back_m, "must be less than depth_m");
  rules.require(!(seat_height_m >= height_m), "seat_height_m", seat_height_m, "must be less than height_m");
  rules.require(!(arm_height_m > height_m), "arm_height_m", arm_height_m, "must be at most height_m");
  rules.require(!(2.0 * foot_m >= std::min(seat_height_m, arm_height_m)), "foot_m", foot_m, "must be less than half of the seat's height");
  rules.color("body_rgb", body_rgb).color("cushion_rgb", cushion_rgb).color("foot_rgb", foot_rgb);
  return rules.messages();
}

ArticulatedModel makeSofa(const SofaShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("sofa");
  const double front = shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const double inner = side - shape.arm_width_m;
  const double back_front = -front + shape.back_m;
  const double cushion_bottom = shape.foot_m + 0.5 * (shape.seat_height_m - shape.foot_m);
  const Finish body = {"body", shape.body_rgb};
  addLegs(builder, boxOf({-front + 0.03, front - 0.03}, {-side + 0.03, side - 0.03}, {0.0, shape.foot_m}), 0.05, {"foot", shape.foot_rgb});
  builder.addCushion(0, boxOf({-front, front}, {-side, -inner}, {shape.foot_m, shape.arm_height_m}), body);
  builder.addCushion(0, boxOf({-front, front}, {inner, side}, {shape.foot_m, shape.arm_height_m}), body);
  builder.addCushion(0, boxOf({-front, back_front}, {-inner, inner}, {shape.foot_m, shape.height_m}), body);
  builder.addBox(0, boxOf({back_front, front - 0.01}, {-inner, inner}, {shape.foot_m, cushion_bottom}), body);
  const double pitch_m = 2.0 * inner / shape.seat_count;
  for (int i = 0; i < shape.seat_count; ++i) {
    const Span width = {-inner + i * pitch_m, -inner + (i + 1) * pitch_m};
    builder.addCushion(0, boxOf({back_front, front}, width, {cushion_bottom, shape.seat_height_m}), {"cushion", shape.cushion_rgb});
  }
  return builder.build();
}

std::vector<std::string> BedShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("mattress_top_m", mattress_top_m);
  rules.length("mattress_m", mattress_m).length("board_m", board_m).length("rail_height_m", rail_height_m);
  rules.between("pillow_count", pillow_count, 0, 4);
  rules.require(!(4.0 * board_m >= std::min(width_m, depth_m)), "board_m", board_m, "must leave room for the mattress");
  rules.require(!(mattress_top_m > height_m), "height_m", height_m, "must be at least mattress_top_m");
  rules.require(!(mattress_m + rail_height_m / 2.0 >= mattress_top_m), "mattress_top_m", mattress_top_m,
                "must be more than the mattress and half of the rail");
  rules.color("frame_rgb", frame_rgb).color("mattress_rgb", mattress_rgb).color("pillow_rgb", pillow_rgb);
  return rules.messages();
}

ArticulatedModel makeBed(const BedShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("bed");
  const double front = shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const double board_m = shape.board_m;
  const Finish frame = {"frame", shape.frame_rgb};
  const double mattress_bottom = shape.mattress_top_m - shape.mattress_m;
  const Span rail = {mattress_bottom - shape.rail_height_m / 2.0, mattress_bottom + std::min(shape.rail_height_m, shape.mattress_m) / 2.0};
  const double inner = side - board_m;
  const Span lying = {-front + board_m, front - board_m};
  builder.addBox(0, boxOf({-front, -front + board_m}, {-side, side}, {0.0, shape.height_m}), frame);
  builder.addBox(0, boxOf({front - board_m, front}, {-side, side}, rail), frame);
  builder.addBox(0, boxOf(lying, {-side, -inner}, rail), frame);
  builder.addBox(0, boxOf(lying, {inner, side}, rail), frame);
  builder.addBox(0, boxOf(lying, {-inner, inner}, {rail.low_m, mattress_bottom}), frame);
  addLegs(builder, boxOf({-front + board_m, front}, {-side, side}, {0.0, rail.low_m}), 2.0 * board_m, frame);
  builder.addCushion(0, boxOf(lying, {-inner, inner}, {mattress_bottom, shape.mattress_top_m}), {"mattress", shape.mattress_rgb});
  const double pitch_m = 2.0 * inner / std::max(1, shape.pillow_count);
  for (int i = 0; i < shape.pillow_count; ++i) {
    const double low = -inner + i * pitch_m;
    const double length_m = std::min(0.4, 0.3 * shape.depth_m);
    builder.addCushion(0,
                       boxOf({lying.low_m + 0.03, lying.low_m + 0.03 + length_m}, {low + 0.08 * pitch_m, low + 0.92 * pitch_m},
                             {shape.mattress_top_m, shape.mattress_top_m + 0.11}),
                       {"pillow", shape.pillow_rgb});
  }
  return builder.build();
}

}  // namespace oikos::model
