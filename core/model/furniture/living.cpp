// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/living.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/model/furniture/builder.h"
#include "core/model/revolved.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

std::vector<std::string> ShelfShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("board_m", board_m);
  rules.between("bottom_m", bottom_m, 0.0, 10.0).between("back_m", back_m, 0.0, 1.0).between("level_count", level_count, 1, 50);
  rules.require(!(2.0 * board_m >= width_m), "board_m", board_m, "must leave room between the sides");
  rules.require(!((level_count + 1) * board_m >= height_m), "level_count", level_count, "must leave room between the boards");
  rules.require(!(back_m >= depth_m), "back_m", back_m, "must be less than depth_m");
  rules.color("body_rgb", body_rgb);
  return rules.messages();
}

ArticulatedModel makeShelf(const ShelfShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("shelf");
  const double front = shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const double inner = side - shape.board_m;
  const Span height = {shape.bottom_m, shape.bottom_m + shape.height_m};
  const Finish finish = {"body", shape.body_rgb};
  builder.addBox(0, boxOf({-front, front}, {-side, -inner}, height), finish);
  builder.addBox(0, boxOf({-front, front}, {inner, side}, height), finish);
  for (int i = 0; i <= shape.level_count; ++i) {
    const double low = height.low_m + (shape.height_m - shape.board_m) * i / shape.level_count;
    const double high = i == shape.level_count ? height.high_m : low + shape.board_m;
    builder.addBox(0, boxOf({-front + shape.back_m, front}, {-inner, inner}, {low, high}), finish);
  }
  if (shape.back_m > 0.0) {
    builder.addBox(0, boxOf({-front, -front + shape.back_m}, {-inner, inner}, height), finish);
  }
  return builder.build();
}

std::vector<std::string> CounterShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("top_m", top_m);
  rules.length("board_m", board_m).between("overhang_m", overhang_m, 0.0, 1.0);
  rules.require(!(2.0 * board_m >= width_m), "board_m", board_m, "must leave room between the sides");
  rules.require(!(overhang_m + board_m >= depth_m), "overhang_m", overhang_m, "must leave room for the panels");
  rules.require(!(top_m >= height_m), "top_m", top_m, "must be less than height_m");
  rules.color("worktop_rgb", worktop_rgb).color("body_rgb", body_rgb);
  return rules.messages();
}

ArticulatedModel makeCounter(const CounterShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("counter");
  const double front = shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const double under = shape.height_m - shape.top_m;
  const Finish body = {"body", shape.body_rgb};
  const Span panel = {-front, front - shape.overhang_m};
  builder.addBox(0, boxOf({-front, front}, {-side, side}, {under, shape.height_m}), {"worktop", shape.worktop_rgb});
  builder.addBox(0, boxOf(panel, {-side, -side + shape.board_m}, {0.0, under}), body);
  builder.addBox(0, boxOf(panel, {side - shape.board_m, side}, {0.0, under}), body);
  builder.addBox(0, boxOf({-front, -front + shape.board_m}, {-side + shape.board_m, side - shape.board_m}, {0.0, under}), body);
  return builder.build();
}

std::vector<std::string> LampShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("height_m", height_m).length("shade_height_m", shade_height_m);
  rules.length("foot_width_m", foot_width_m).length("pole_m", pole_m).between("shade_top_ratio", shade_top_ratio, 0.2, 1.0);
  rules.require(!(shade_height_m >= 0.9 * height_m), "shade_height_m", shade_height_m, "must leave room for the pole");
  rules.require(!(pole_m >= std::min(0.2 * width_m, foot_width_m)), "pole_m", pole_m, "must be less than foot_width_m and width_m / 5");
  rules.color("foot_rgb", foot_rgb).color("shade_rgb", shade_rgb);
  return rules.messages();
}

ArticulatedModel makeLamp(const LampShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("lamp");
  const double foot_m = 0.02 * shape.height_m;
  const double shade_bottom = shape.height_m - shape.shade_height_m;
  const Finish foot = {"foot", shape.foot_rgb};
  const auto radius = static_cast<float>(shape.foot_width_m / 2.0);
  builder.addShape(0,
                   makeTaperedCylinder(
                       {.bottom_radius_m = radius, .top_radius_m = 0.9F * radius, .height_m = static_cast<float>(foot_m), .segments = 32}),
                   Eigen::Vector3d::Zero(), foot);
  const double pole_top = shape.height_m - 0.3 * shape.shade_height_m;
  builder.addRod(0, {Eigen::Vector3d(0.0, 0.0, foot_m), Eigen::Vector3d(0.0, 0.0, pole_top), shape.pole_m / 2.0}, foot);
  const double shade_m = shape.width_m / 2.0;
  const double spoke_m = 0.99 * shade_m * (1.0 - 0.7 * (1.0 - shape.shade_top_ratio));  // ends within the shade's wall
  const Eigen::Vector3d spoke(0.0, spoke_m, 0.0);
  const Eigen::Vector3d hub(0.0, 0.0, pole_top);
  builder.addRod(0, {hub - spoke, hub + spoke, 0.1 * shape.pole_m}, foot);
  builder.addShape(0,
                   makeTube({.bottom_radius_m = static_cast<float>(shade_m),
                             .top_radius_m = static_cast<float>(shade_m * shape.shade_top_ratio),
                             .height_m = static_cast<float>(shape.shade_height_m),
                             .wall_m = static_cast<float>(0.02 * shade_m),
                             .segments = 32}),
                   Eigen::Vector3d(0.0, 0.0, shade_bottom), {"shade", shape.shade_rgb});
  return builder.build();
}

std::vector<std::string> TvShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("panel_m", panel_m);
  rules.between("foot_height_m", foot_height_m, 0.02, 10.0).between("frame_m", frame_m, 0.0, 1.0);
  rules.require(!(panel_m > depth_m), "panel_m", panel_m, "must be at most depth_m");
  rules.require(!(foot_height_m + 2.0 * frame_m >= height_m), "foot_height_m", foot_height_m, "must leave room for the screen");
  rules.require(!(2.0 * frame_m >= width_m), "frame_m", frame_m, "must leave room for the screen");
  rules.color("body_rgb", body_rgb).color("screen_rgb", screen_rgb);
  return rules.messages();
}

ArticulatedModel makeTv(const TvShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("tv");
  constexpr double kPlate_m = 0.01;
  const double side = shape.width_m / 2.0;
  const double face = shape.panel_m / 2.0;
  const double frame_m = shape.frame_m;
  const Finish body = {"body", shape.body_rgb};
  builder.addBox(0, boxOf({-shape.depth_m / 2.0, shape.depth_m / 2.0}, {-0.25 * shape.width_m, 0.25 * shape.width_m}, {0.0, kPlate_m}),
                 body);
  builder.addBox(0, boxOf({-0.4 * face, 0.4 * face}, {-0.06 * shape.width_m, 0.06 * shape.width_m}, {kPlate_m, shape.foot_height_m}), body);
  const double skin_m = 0.1 * shape.panel_m;  // the screen lies before the case, a little behind its face
  builder.addBox(0, boxOf({-face, face - skin_m}, {-side, side}, {shape.foot_height_m, shape.height_m}), body);
  const Span y = {-side + frame_m, side - frame_m};
  const Span z = {shape.foot_height_m + frame_m, shape.height_m - frame_m};
  builder.addBox(0, boxOf({face - skin_m, face - 0.5 * skin_m}, y, z), {"screen", shape.screen_rgb});
  if (frame_m > 0.0) {
    const Span skin = {face - skin_m, face};
    builder.addBox(0, boxOf(skin, {-side, y.low_m}, {shape.foot_height_m, shape.height_m}), body);
    builder.addBox(0, boxOf(skin, {y.high_m, side}, {shape.foot_height_m, shape.height_m}), body);
    builder.addBox(0, boxOf(skin, y, {shape.foot_height_m, z.low_m}), body);
    builder.addBox(0, boxOf(skin, y, {z.high_m, shape.height_m}), body);
  }
  return builder.build();
}

std::vector<std::string> RugShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).between("border_m", border_m, 0.0, 10.0);
  rules.require(!(2.0 * border_m >= std::min(width_m, depth_m)), "border_m", border_m, "must leave room for the middle");
  rules.color("middle_rgb", middle_rgb).color("border_rgb", border_rgb);
  return rules.messages();
}

ArticulatedModel makeRug(const RugShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("rug");
  const double front = shape.depth_m / 2.0;
  const double side = shape.width_m / 2.0;
  const Span x = {-front + shape.border_m, front - shape.border_m};
  const Span y = {-side + shape.border_m, side - shape.border_m};
  const Span height = {0.0, shape.height_m};
  builder.addBox(0, boxOf(x, y, height), {"middle", shape.middle_rgb});
  if (shape.border_m > 0.0) {
    const Finish border = {"border", shape.border_rgb};
    builder.addBox(0, boxOf({-front, x.low_m}, {-side, side}, height), border);
    builder.addBox(0, boxOf({x.high_m, front}, {-side, side}, height), border);
    builder.addBox(0, boxOf(x, {-side, y.low_m}, height), border);
    builder.addBox(0, boxOf(x, {y.high_m, side}, height), border);
  }
  return builder.build();
}

}  // namespace oikos::model
