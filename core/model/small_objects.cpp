// SPDX-License-Identifier: Apache-2.0
// The round ones; those with corners are in small_boxes.cpp.
#include "core/model/small_objects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/model/finish.h"
#include "core/model/revolved.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

namespace {

constexpr int kSides = 40;
constexpr int kBowlSteps = 8;

/// In double, so that points which differ by a wall do not differ by rounding.
struct Corner {
  double radius_m;
  double z_m;
  int material;
};

TriangleMesh makeRound(const std::vector<Corner>& corners, const std::vector<Finish>& finishes) {
  RevolvedShape shape = {.profile = {}, .segments = kSides, .scale = TextureScale::kWhole};
  for (const Corner& corner : corners) {
    shape.profile.push_back({static_cast<float>(corner.radius_m), static_cast<float>(corner.z_m), corner.material});
  }
  TriangleMesh mesh = makeRevolved(shape);
  mesh.materials.clear();
  for (const Finish& finish : finishes) {
    mesh.materials.push_back(makeMaterial(finish));
  }
  return mesh;
}

double handleArc(const CupShape& shape) {
  return shape.handle_reach_m + shape.wall_m / 2.0 - shape.handle_rod_m / 2.0;
}

/// A half circle whose ends lie in the middle of the wall, tilted as the wall is, so that they show neither inside nor beside it.
void addCupHandle(TriangleMesh& mesh, const CupShape& shape) {
  const double slope = (shape.diameter_m - shape.bottom_diameter_m) / 2.0 / shape.height_m;
  const double middle_m = (shape.diameter_m + shape.bottom_diameter_m) / 4.0 - shape.wall_m / 2.0;
  TriangleMesh handle = makeBentRod({.arc_radius_m = static_cast<float>(handleArc(shape)),
                                     .rod_radius_m = static_cast<float>(shape.handle_rod_m / 2.0),
                                     .from_rad = static_cast<float>(-std::numbers::pi / 2.0),
                                     .to_rad = static_cast<float>(std::numbers::pi / 2.0)});
  Eigen::Isometry3d T_cup_handle = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d up = Eigen::Vector3d(0.0, slope, 1.0).normalized();
  T_cup_handle.linear() << Eigen::Vector3d(0.0, up.z(), -up.y()), -Eigen::Vector3d::UnitX(), up;
  T_cup_handle.translation() << 0.0, middle_m, shape.height_m / 2.0;
  append(mesh, handle, T_cup_handle);
  mesh.materials.pop_back();
  std::fill(mesh.triangle_materials.end() - static_cast<std::ptrdiff_t>(handle.triangles.size()), mesh.triangle_materials.end(), 1);
}

/// From the foot, upright at the rim: a quarter of an ellipse.
std::vector<Corner> bowlCurve(const Corner& foot, const Corner& rim) {
  std::vector<Corner> curve;
  for (int i = 0; i <= kBowlSteps; ++i) {
    const double angle_rad = std::numbers::pi / 2.0 * i / kBowlSteps;
    const bool at_rim = i == kBowlSteps;
    curve.push_back({at_rim ? rim.radius_m : foot.radius_m + (rim.radius_m - foot.radius_m) * std::sin(angle_rad),
                     at_rim ? rim.z_m : foot.z_m + (rim.z_m - foot.z_m) * (1.0 - std::cos(angle_rad)), foot.material});
  }
  return curve;
}

}  // namespace

std::vector<std::string> CupShape::validate() const {
  ShapeRules rules("object");
  rules.length("diameter_m", diameter_m).length("bottom_diameter_m", bottom_diameter_m).length("height_m", height_m);
  rules.length("wall_m", wall_m).length("bottom_m", bottom_m).length("handle_rod_m", handle_rod_m);
  rules.between("handle_reach_m", handle_reach_m, 0.0, 1.0);
  rules.require(!(2.0 * wall_m >= std::min(diameter_m, bottom_diameter_m)), "wall_m", wall_m, "must leave room inside");
  rules.require(!(bottom_m >= height_m), "bottom_m", bottom_m, "must be less than height_m");
  rules.require(handle_reach_m == 0.0 || handle_reach_m > handle_rod_m, "handle_reach_m", handle_reach_m,
                "must be 0, or more than handle_rod_m");
  rules.require(handle_reach_m == 0.0 || 2.0 * handleArc(*this) + handle_rod_m <= height_m, "handle_reach_m", handle_reach_m,
                "must be less than about half of height_m: the handle is a half circle");
  rules.color("outside_rgb", outside_rgb).color("body_rgb", body_rgb).color("inside_rgb", inside_rgb);
  return rules.messages();
}

TriangleMesh makeCup(const CupShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  const double top_m = shape.diameter_m / 2.0;
  const double foot_m = shape.bottom_diameter_m / 2.0;
  const double inner_foot_m = foot_m + (top_m - foot_m) * shape.bottom_m / shape.height_m - shape.wall_m;
  TriangleMesh mesh = makeRound({{0.0, 0.0, 1},
                                 {foot_m, 0.0, 0},
                                 {top_m, shape.height_m, 1},
                                 {top_m - shape.wall_m, shape.height_m, 2},
                                 {inner_foot_m, shape.bottom_m, 2},
                                 {0.0, shape.bottom_m, 2}},
                                {{"outside", shape.outside_rgb}, {"body", shape.body_rgb}, {"inside", shape.inside_rgb}});
  if (shape.handle_reach_m > 0.0) {
    addCupHandle(mesh, shape);
  }
  return mesh;
}

std::vector<std::string> BowlShape::validate() const {
  ShapeRules rules("object");
  rules.length("diameter_m", diameter_m).length("height_m", height_m).length("foot_diameter_m", foot_diameter_m);
  rules.length("wall_m", wall_m);
  rules.require(!(foot_diameter_m > diameter_m), "foot_diameter_m", foot_diameter_m, "must be at most diameter_m");
  rules.require(!(2.0 * wall_m >= foot_diameter_m || wall_m >= height_m), "wall_m", wall_m, "must leave room inside");
  rules.color("outside_rgb", outside_rgb).color("inside_rgb", inside_rgb);
  return rules.messages();
}

TriangleMesh makeBowl(const BowlShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  const double rim_m = shape.diameter_m / 2.0;
  const double foot_m = shape.foot_diameter_m / 2.0;
  const double wall_m = shape.wall_m;
  std::vector<Corner> corners = {{0.0, 0.0, 1}};
  for (const Corner& corner : bowlCurve({foot_m, 0.0, 0}, {rim_m, shape.height_m, 0})) {
    corners.push_back(corner);
  }
  corners.back().material = 1;
  std::vector<Corner> inside = bowlCurve({foot_m - wall_m, wall_m, 2}, {rim_m - wall_m, shape.height_m, 2});
  corners.insert(corners.end(), inside.rbegin(), inside.rend());
  corners.push_back({0.0, wall_m, 2});
  return makeRound(corners, {{"outside", shape.outside_rgb}, {"body", shape.outside_rgb}, {"inside", shape.inside_rgb}});
}

std::vector<std::string> PlateShape::validate() const {
  ShapeRules rules("object");
  rules.length("diameter_m", diameter_m).length("height_m", height_m).length("well_diameter_m", well_diameter_m);
  rules.length("wall_m", wall_m);
  rules.require(!(well_diameter_m >= diameter_m), "well_diameter_m", well_diameter_m, "must be less than diameter_m");
  rules.require(!(wall_m >= height_m), "wall_m", wall_m, "must be less than height_m");
  rules.color("body_rgb", body_rgb).color("inside_rgb", inside_rgb);
  return rules.messages();
}

TriangleMesh makePlate(const PlateShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  const double rim_m = shape.diameter_m / 2.0;
  const double well_m = shape.well_diameter_m / 2.0;
  // Narrow strips on both sides of the bend keep the shading of the well and of the rim flat.
  const double before_m = 0.94 * well_m;
  const double after_m = well_m + 0.1 * (rim_m - well_m);
  const double after_z = shape.wall_m + 0.1 * (shape.height_m - shape.wall_m);
  return makeRound({{0.0, 0.0, 0},
                    {well_m, 0.0, 0},
                    {rim_m, shape.height_m - shape.wall_m, 0},
                    {rim_m, shape.height_m, 1},
                    {after_m, after_z, 1},
                    {well_m, shape.wall_m, 1},
                    {before_m, shape.wall_m, 1},
                    {0.0, shape.wall_m, 1}},
                   {{"body", shape.body_rgb}, {"inside", shape.inside_rgb}});
}

std::vector<std::string> BottleShape::validate() const {
  ShapeRules rules("object");
  rules.length("diameter_m", diameter_m).length("height_m", height_m).length("neck_diameter_m", neck_diameter_m);
  rules.length("cap_height_m", cap_height_m);
  rules.require(!(neck_diameter_m > diameter_m), "neck_diameter_m", neck_diameter_m, "must be at most diameter_m");
  rules.require(label_low_m > 0.0, "label_low_m", label_low_m, "must be > 0");
  rules.require(label_high_m > label_low_m, "label_high_m", label_high_m, "must be > label_low_m");
  rules.require(shoulder_height_m > label_high_m, "shoulder_height_m", shoulder_height_m, "must be > label_high_m");
  rules.require(neck_height_m > shoulder_height_m, "neck_height_m", neck_height_m, "must be > shoulder_height_m");
  rules.require(height_m - cap_height_m > neck_height_m, "height_m", height_m, "must be > neck_height_m + cap_height_m");
  rules.color("body_rgb", body_rgb).color("label_rgb", label_rgb).color("cap_rgb", cap_rgb);
  return rules.messages();
}

TriangleMesh makeBottle(const BottleShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  const double radius_m = shape.diameter_m / 2.0;
  const double neck_m = shape.neck_diameter_m / 2.0;
  std::vector<Corner> corners = {{0.0, 0.0, 0},
                                 {radius_m, 0.0, 0},
                                 {radius_m, shape.label_low_m, 1},
                                 {radius_m, shape.label_high_m, 0},
                                 {radius_m, shape.shoulder_height_m, 0}};
  constexpr int kShoulderSteps = 8;  // half a wave of the cosine from the body to the neck
  for (int i = 1; i < kShoulderSteps; ++i) {
    const double share = static_cast<double>(i) / kShoulderSteps;
    const double fallen = (1.0 - std::cos(std::numbers::pi * share)) / 2.0;
    corners.push_back(
        {radius_m + (neck_m - radius_m) * fallen, shape.shoulder_height_m + (shape.neck_height_m - shape.shoulder_height_m) * share, 0});
  }
  const double cap_bottom = shape.height_m - shape.cap_height_m;
  const double cap_m = std::min(1.12 * neck_m, radius_m);
  corners.push_back({neck_m, shape.neck_height_m, 0});
  corners.push_back({neck_m, cap_bottom, 2});
  if (cap_m > neck_m) {
    corners.push_back({cap_m, cap_bottom, 2});
  }
  corners.push_back({cap_m, shape.height_m, 2});
  corners.push_back({0.0, shape.height_m, 2});
  return makeRound(corners, {{"body", shape.body_rgb}, {"label", shape.label_rgb}, {"cap", shape.cap_rgb}});
}

std::vector<std::string> TinShape::validate() const {
  ShapeRules rules("object");
  rules.length("diameter_m", diameter_m).length("height_m", height_m).length("rim_m", rim_m);
  rules.require(!(4.0 * rim_m >= std::min(diameter_m, height_m)), "rim_m", rim_m, "must be less than a quarter of the tin");
  rules.color("label_rgb", label_rgb).color("metal_rgb", metal_rgb);
  return rules.messages();
}

TriangleMesh makeTin(const TinShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  const double rim_m = shape.rim_m;
  const double outer_m = shape.diameter_m / 2.0;
  const double mantle_m = outer_m - rim_m / 3.0;
  const double inner_m = outer_m - rim_m;
  const double top = shape.height_m;
  return makeRound({{0.0, rim_m, 1},
                    {inner_m, rim_m, 1},
                    {inner_m, 0.0, 1},
                    {outer_m, 0.0, 1},
                    {outer_m, rim_m, 1},
                    {mantle_m, rim_m, 0},
                    {mantle_m, top - rim_m, 1},
                    {outer_m, top - rim_m, 1},
                    {outer_m, top, 1},
                    {inner_m, top, 1},
                    {inner_m, top - rim_m, 1},
                    {0.0, top - rim_m, 1}},
                   {{"label", shape.label_rgb}, {"metal", shape.metal_rgb}});
}

std::vector<std::string> JarShape::validate() const {
  ShapeRules rules("object");
  rules.length("diameter_m", diameter_m).length("height_m", height_m).length("lid_height_m", lid_height_m);
  rules.require(!(lid_height_m >= 0.8 * height_m), "lid_height_m", lid_height_m, "must be less than 0.8 height_m");
  rules.color("label_rgb", label_rgb).color("body_rgb", body_rgb).color("lid_rgb", lid_rgb);
  return rules.messages();
}

TriangleMesh makeJar(const JarShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  const double radius_m = shape.diameter_m / 2.0;
  const double lid_m = shape.lid_height_m;
  const double rim = shape.height_m - lid_m;
  return makeRound({{0.0, 0.0, 1},
                    {0.94 * radius_m, 0.0, 1},
                    {0.97 * radius_m, 0.03 * shape.height_m, 0},
                    {0.97 * radius_m, rim, 2},
                    {radius_m, rim, 2},
                    {radius_m, rim + 0.35 * lid_m, 2},
                    {0.9 * radius_m, rim + 0.5 * lid_m, 2},
                    {0.18 * radius_m, rim + 0.55 * lid_m, 2},
                    {0.18 * radius_m, rim + 0.65 * lid_m, 2},
                    {0.26 * radius_m, rim + 0.8 * lid_m, 2},
                    {0.2 * radius_m, shape.height_m, 2},
                    {0.0, shape.height_m, 2}},
                   {{"label", shape.label_rgb}, {"body", shape.body_rgb}, {"lid", shape.lid_rgb}});
}

}  // namespace oikos::model
