// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/sanitary.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/model/furniture/carcass.h"
#include "core/model/furniture/fronts.h"
#include "core/model/revolved.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

namespace {

struct Tap {
  Eigen::Vector3d foot_model;
  Eigen::Vector3d towards;  ///< where its spout reaches to, length 1
  double height_m;
  double reach_m;
};

void addTap(FurnitureBuilder& builder, const Tap& tap, const Finish& finish) {
  if (tap.height_m <= 0.0) {
    return;
  }
  const double radius_m = std::min(0.012, 0.15 * tap.height_m);
  const Eigen::Vector3d top = tap.foot_model + Eigen::Vector3d(0.0, 0.0, tap.height_m - radius_m);
  const Eigen::Vector3d end = top + tap.towards * tap.reach_m;
  builder.addRod(0, {tap.foot_model, top + Eigen::Vector3d(0.0, 0.0, radius_m), 1.4 * radius_m}, finish);
  builder.addRod(0, {top, end, radius_m}, finish);
  builder.addRod(0, {end, end - Eigen::Vector3d(0.0, 0.0, 0.15 * tap.height_m), 0.9 * radius_m}, finish);
}

/// A box without its lid: `inner` is hollow up to the top of `outer`.
void addOpenBox(FurnitureBuilder& builder, const Eigen::AlignedBox3d& outer, const Eigen::AlignedBox3d& inner, const Finish& finish) {
  const Span height = {outer.min().z(), outer.max().z()};
  const Span inner_x = {inner.min().x(), inner.max().x()};
  const Span inner_y = {inner.min().y(), inner.max().y()};
  const Span width = {outer.min().y(), outer.max().y()};
  builder.addBox(0, boxOf({outer.min().x(), inner_x.low_m}, width, height), finish);
  builder.addBox(0, boxOf({inner_x.high_m, outer.max().x()}, width, height), finish);
  builder.addBox(0, boxOf(inner_x, {width.low_m, inner_y.low_m}, height), finish);
  builder.addBox(0, boxOf(inner_x, {inner_y.high_m, width.high_m}, height), finish);
  builder.addBox(0, boxOf(inner_x, inner_y, {height.low_m, inner.min().z()}), finish);
}

/// Of a round shape: made oval, longer by `ratio` along x.
TriangleMesh stretched(TriangleMesh mesh, double ratio) {
  const auto factor = static_cast<float>(ratio);
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    vertex.x() *= factor;
  }
  for (Eigen::Vector3f& normal : mesh.normals) {
    normal.x() /= factor;
    normal.normalize();
  }
  return mesh;
}

constexpr double kBasinWall_m = 0.004;

struct SinkPlan {
  Eigen::AlignedBox3d carcass;
  Eigen::AlignedBox3d worktop;
  Eigen::AlignedBox3d basin;
  std::vector<HingedFront> doors;
};

SinkPlan planSink(const SinkUnitShape& shape) {
  const double face = shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const double under = shape.height_m - shape.worktop_thickness_m;
  const double basin_x = face - 0.09 - shape.basin_depth_m / 2.0;  // nearer to the front than to the tap
  SinkPlan plan = {
      .carcass = boxOf({-face, face - shape.board_m - kBumper_m}, {-side, side}, {shape.plinth_height_m, under}),
      .worktop = boxOf({-face, face + shape.worktop_overhang_m}, {-side, side}, {under, shape.height_m}),
      .basin = boxOf({basin_x - shape.basin_depth_m / 2.0, basin_x + shape.basin_depth_m / 2.0},
                     {-shape.basin_width_m / 2.0, shape.basin_width_m / 2.0}, {shape.height_m - shape.basin_height_m, shape.height_m}),
      .doors = {}};
  const double gap_m = shape.door_gap_m / 2.0;
  const Span depth = {face - shape.board_m, face};
  const Span height = {shape.plinth_height_m + gap_m, under - gap_m};
  plan.doors.push_back({"left_door", boxOf(depth, {-side + gap_m, -gap_m}, height), HingeEdge::kLeft, shape.door_opening_rad});
  plan.doors.push_back({"right_door", boxOf(depth, {gap_m, side - gap_m}, height), HingeEdge::kRight, shape.door_opening_rad});
  return plan;
}

HandleRule handleRule(const SinkUnitShape& shape) {
  return {.style = shape.handle, .length_m = shape.handle_length_m, .offset_m = shape.handle_offset_m, .level = shape.handle_level};
}

void addSinkTop(FurnitureBuilder& builder, const SinkUnitShape& shape) {
  const SinkPlan plan = planSink(shape);
  const Finish worktop = {"worktop", shape.worktop_rgb};
  const Eigen::Vector3d low = plan.worktop.min();
  const Eigen::Vector3d high = plan.worktop.max();
  const Span height = {low.z(), high.z()};
  const Span basin_x = {plan.basin.min().x(), plan.basin.max().x()};
  builder.addBox(0, boxOf({low.x(), basin_x.low_m}, {low.y(), high.y()}, height), worktop);
  builder.addBox(0, boxOf({basin_x.high_m, high.x()}, {low.y(), high.y()}, height), worktop);
  builder.addBox(0, boxOf(basin_x, {low.y(), plan.basin.min().y()}, height), worktop);
  builder.addBox(0, boxOf(basin_x, {plan.basin.max().y(), high.y()}, height), worktop);
  const Eigen::Vector3d wall = Eigen::Vector3d::Constant(kBasinWall_m);
  addOpenBox(builder, plan.basin, {plan.basin.min() + wall, plan.basin.max() - wall}, {"basin", shape.basin_rgb});
  const Tap tap = {.foot_model = {(low.x() + basin_x.low_m) / 2.0, 0.0, high.z()},
                   .towards = Eigen::Vector3d::UnitX(),
                   .height_m = shape.tap_height_m,
                   .reach_m = 0.5 * shape.basin_depth_m};
  addTap(builder, tap, {"tap", shape.tap_rgb});
}

}  // namespace

std::vector<std::string> SinkUnitShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("board_m", board_m);
  rules.length("worktop_thickness_m", worktop_thickness_m).between("worktop_overhang_m", worktop_overhang_m, 0.0, 1.0);
  rules.length("basin_width_m", basin_width_m).length("basin_depth_m", basin_depth_m).length("basin_height_m", basin_height_m);
  rules.between("plinth_height_m", plinth_height_m, 0.0, 10.0).between("tap_height_m", tap_height_m, 0.0, 2.0);
  rules.between("door_gap_m", door_gap_m, 0.0, 0.1).angle("door_opening_deg", door_opening_rad, 5.0, 183.0);
  rules.length("handle_length_m", handle_length_m).between("handle_offset_m", handle_offset_m, 0.0, 100.0);
  rules.between("handle_level", handle_level, 0.0, 1.0);
  rules.color("body_rgb", body_rgb).color("front_rgb", front_rgb).color("handle_rgb", handle_rgb).color("plinth_rgb", plinth_rgb);
  rules.color("worktop_rgb", worktop_rgb).color("basin_rgb", basin_rgb).color("tap_rgb", tap_rgb);
  if (!rules.messages().empty()) {
    return rules.messages();
  }
  const SinkPlan plan = planSink(*this);
  rules.require(basin_width_m < width_m - 2.0 * board_m, "basin_width_m", basin_width_m, "must fit between the sides");
  rules.require(plan.basin.min().x() > -depth_m / 2.0 + 0.05, "basin_depth_m", basin_depth_m,
                "must leave 0.09 m before the basin and 0.05 m behind it");
  rules.require(basin_height_m > worktop_thickness_m && basin_height_m < plan.carcass.sizes().z() - board_m, "basin_height_m",
                basin_height_m, "must be more than the worktop and end above the cupboard's bottom");
  for (const HingedFront& door : plan.doors) {
    rules.require(handleFits(door, handleRule(*this)), "handle_length_m", handle_length_m,
                  "must fit on the door with handle_offset_m from its edge");
    rules.require(turningRoom(door) <= door_gap_m, "door_gap_m", door_gap_m,
                  "must let a door turn past the other: larger, or board_m less");
  }
  return rules.messages();
}

ArticulatedModel makeSinkUnit(const SinkUnitShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("sink_unit");
  const SinkPlan plan = planSink(shape);
  Eigen::AlignedBox3d plinth = plan.carcass;
  plinth.min().z() = 0.0;
  plinth.max().z() = shape.plinth_height_m;
  const Finish body = {"body", shape.body_rgb};
  addPlinth(builder, plinth, shape.board_m, {"plinth", shape.plinth_rgb});
  addCarcass(builder, {.outer_model = plan.carcass, .board_m = shape.board_m, .has_top = false, .finish = body, .shelf_finish = body});
  addSinkTop(builder, shape);
  for (const HingedFront& door : plan.doors) {
    addBoardDoor(builder, door, handleRule(shape), {"front", shape.front_rgb}, {"handle", shape.handle_rgb});
  }
  return builder.build();
}

std::vector<std::string> ToiletShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("seat_height_m", seat_height_m);
  rules.length("cistern_depth_m", cistern_depth_m).length("lid_m", lid_m).angle("lid_opening_deg", lid_opening_rad, 5.0, 90.0);
  rules.require(!(seat_height_m >= height_m), "seat_height_m", seat_height_m, "must be less than height_m");
  rules.require(!(cistern_depth_m + 4.0 * lid_m >= depth_m), "cistern_depth_m", cistern_depth_m, "must leave room for the seat");
  rules.require(!(4.0 * lid_m >= seat_height_m), "lid_m", lid_m, "must be less than a quarter of seat_height_m");
  rules.color("body_rgb", body_rgb).color("lid_rgb", lid_rgb);
  return rules.messages();
}

ArticulatedModel makeToilet(const ToiletShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("toilet");
  constexpr double kLidPlay_m = 0.002;
  constexpr int kSides = 32;
  const double front = shape.depth_m / 2.0;
  const double cistern_front = -front + shape.cistern_depth_m;
  const double rim_z = shape.seat_height_m - shape.lid_m - kLidPlay_m;
  const Finish body = {"body", shape.body_rgb};
  const auto radius = static_cast<float>(shape.width_m / 2.0);
  const auto rim = static_cast<float>(rim_z);
  const TriangleMesh bowl = makeRevolved({.profile = {{0.0F, 0.0F},
                                                      {0.6F * radius, 0.0F},
                                                      {0.6F * radius, 0.25F * rim},
                                                      {0.9F * radius, 0.7F * rim},
                                                      {radius, 0.9F * rim},
                                                      {radius, rim},
                                                      {0.72F * radius, rim},
                                                      {0.6F * radius, 0.75F * rim},
                                                      {0.25F * radius, 0.5F * rim},
                                                      {0.0F, 0.5F * rim}},
                                          .segments = kSides});
  const double bowl_m = front - cistern_front;
  builder.addShape(0, stretched(bowl, bowl_m / shape.width_m), Eigen::Vector3d((front + cistern_front) / 2.0, 0.0, 0.0), body);
  builder.addBox(0, boxOf({-front, cistern_front + 0.12 * bowl_m}, {-0.25 * shape.width_m, 0.25 * shape.width_m}, {0.0, 0.9 * rim_z}),
                 body);
  builder.addCushion(0, boxOf({-front, cistern_front}, {-shape.width_m / 2.0, shape.width_m / 2.0}, {0.9 * rim_z, shape.height_m}), body);
  // Open, the lid stands in the room that its hinge leaves before the cistern.
  const double hinge_x = cistern_front + shape.lid_m + 0.01;
  const double lid_bottom = rim_z + kLidPlay_m;
  const int lid =
      builder.addTurningPart("lid", {Eigen::Vector3d(hinge_x, 0.0, lid_bottom), -Eigen::Vector3d::UnitY(), shape.lid_opening_rad});
  const TriangleMesh cover = makeCylinder({.radius_m = radius, .length_m = static_cast<float>(shape.lid_m), .segments = kSides});
  const Finish lid_finish = {"lid", shape.lid_rgb};
  builder.addShape(lid, stretched(cover, (front - hinge_x) / shape.width_m),
                   Eigen::Vector3d((front + hinge_x) / 2.0, 0.0, lid_bottom + shape.lid_m / 2.0), lid_finish);
  builder.addBox(lid,
                 boxOf({hinge_x, hinge_x + 0.2 * bowl_m}, {-0.3 * shape.width_m, 0.3 * shape.width_m},
                       {lid_bottom + 0.1 * shape.lid_m, lid_bottom + 0.9 * shape.lid_m}),
                 lid_finish);
  return builder.build();
}

std::vector<std::string> BathtubShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("rim_m", rim_m);
  rules.length("bottom_m", bottom_m).between("tap_height_m", tap_height_m, 0.0, 2.0);
  rules.require(!(2.0 * rim_m >= std::min(width_m, depth_m)), "rim_m", rim_m, "must leave room inside");
  rules.require(!(bottom_m >= height_m), "bottom_m", bottom_m, "must be less than height_m");
  rules.color("body_rgb", body_rgb).color("tap_rgb", tap_rgb);
  return rules.messages();
}

ArticulatedModel makeBathtub(const BathtubShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("bathtub");
  const double front = shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const Eigen::AlignedBox3d outer = boxOf({-front, front}, {-side, side}, {0.0, shape.height_m});
  const Eigen::AlignedBox3d inner =
      boxOf({-front + shape.rim_m, front - shape.rim_m}, {-side + shape.rim_m, side - shape.rim_m}, {shape.bottom_m, shape.height_m});
  addOpenBox(builder, outer, inner, {"body", shape.body_rgb});
  const Tap tap = {.foot_model = {0.0, side - shape.rim_m / 2.0, shape.height_m},
                   .towards = -Eigen::Vector3d::UnitY(),
                   .height_m = shape.tap_height_m,
                   .reach_m = 1.6 * shape.rim_m};
  addTap(builder, tap, {"tap", shape.tap_rgb});
  return builder.build();
}

std::vector<std::string> WashbasinShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("rim_m", rim_m);
  rules.length("basin_height_m", basin_height_m).length("shelf_m", shelf_m).length("pedestal_width_m", pedestal_width_m);
  rules.between("tap_height_m", tap_height_m, 0.0, 2.0);
  rules.require(!(2.0 * rim_m >= width_m), "rim_m", rim_m, "must leave room inside");
  rules.require(!(shelf_m + rim_m >= depth_m), "shelf_m", shelf_m, "must leave room for the basin before it");
  rules.require(!(basin_height_m >= height_m), "basin_height_m", basin_height_m, "must be less than height_m");
  rules.require(!(rim_m >= basin_height_m), "rim_m", rim_m, "must be less than basin_height_m");
  rules.require(!(1.2 * pedestal_width_m > std::min(width_m, depth_m)), "pedestal_width_m", pedestal_width_m,
                "must be less than the basin by a fifth");
  rules.color("body_rgb", body_rgb).color("tap_rgb", tap_rgb);
  return rules.messages();
}

ArticulatedModel makeWashbasin(const WashbasinShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("washbasin");
  const double front = shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const double under = shape.height_m - shape.basin_height_m;
  const Finish body = {"body", shape.body_rgb};
  const Eigen::AlignedBox3d outer = boxOf({-front, front}, {-side, side}, {under, shape.height_m});
  const Eigen::AlignedBox3d inner = boxOf({-front + shape.shelf_m, front - shape.rim_m}, {-side + shape.rim_m, side - shape.rim_m},
                                          {under + shape.rim_m, shape.height_m});
  addOpenBox(builder, outer, inner, body);
  const auto radius = static_cast<float>(shape.pedestal_width_m / 2.0);
  builder.addShape(0,
                   makeTaperedCylinder(
                       {.bottom_radius_m = radius, .top_radius_m = 1.2F * radius, .height_m = static_cast<float>(under), .segments = 32}),
                   Eigen::Vector3d::Zero(), body);
  const Tap tap = {.foot_model = {-front + shape.shelf_m / 2.0, 0.0, shape.height_m},
                   .towards = Eigen::Vector3d::UnitX(),
                   .height_m = shape.tap_height_m,
                   .reach_m = shape.shelf_m + 0.03};
  addTap(builder, tap, {"tap", shape.tap_rgb});
  return builder.build();
}

}  // namespace oikos::model
