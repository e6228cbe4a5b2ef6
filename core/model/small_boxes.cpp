// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/model/finish.h"
#include "core/model/revolved.h"
#include "core/model/shape_rules.h"
#include "core/model/small_objects.h"

namespace oikos::model {

namespace {

/// In the order of makeBox's faces.
constexpr std::array<const char*, 6> kFaceNames = {"back", "front", "left", "right", "bottom", "top"};

Eigen::AlignedBox3f standingBox(double width_m, double depth_m, double height_m) {
  const Eigen::Vector3f half = Eigen::Vector3d(depth_m / 2.0, width_m / 2.0, 0.0).cast<float>();
  Eigen::AlignedBox3f box(-half, half);
  box.max().z() = static_cast<float>(height_m);
  return box;
}

/// A box whose faces bear these materials, in the order of makeBox's faces.
TriangleMesh makeNamedBox(const Eigen::AlignedBox3f& bounds, const std::array<Finish, 6>& finishes) {
  TriangleMesh mesh = makeBoxBetween(bounds, TextureScale::kWhole);
  for (std::uint32_t face = 0; face < 6; ++face) {
    mesh.materials.push_back(makeMaterial(finishes[face]));
    mesh.triangle_materials.insert(mesh.triangle_materials.end(), 2, face);
  }
  return mesh;
}

TriangleMesh makePackage(const Eigen::AlignedBox3f& bounds, std::uint32_t rgb) {
  std::array<Finish, 6> finishes;
  std::transform(kFaceNames.begin(), kFaceNames.end(), finishes.begin(), [&](const char* name) { return Finish{name, rgb}; });
  return makeNamedBox(bounds, finishes);
}

/// Two slopes to a ridge along y on a rectangle of the box's width and depth, closed below.
TriangleMesh makeRoof(const Eigen::AlignedBox3f& bounds) {
  const Eigen::Vector3f low = bounds.min();
  const Eigen::Vector3f high = bounds.max();
  TriangleMesh roof;
  roof.vertices = {{low.x(), low.y(), low.z()},  {high.x(), low.y(), low.z()}, {high.x(), high.y(), low.z()},
                   {low.x(), high.y(), low.z()}, {0.0F, low.y(), high.z()},    {0.0F, high.y(), high.z()}};
  roof.triangles = {{0, 2, 1}, {0, 3, 2}, {1, 2, 5}, {1, 5, 4}, {3, 0, 4}, {3, 4, 5}, {0, 1, 4}, {2, 3, 5}};
  roof = withFlatNormals(roof);
  for (std::size_t i = 0; i < roof.vertices.size(); ++i) {  // seen from the side that each face looks to most, or from above
    const Eigen::Vector3f share = (roof.vertices[i] - low).cwiseQuotient(high - low);
    const Eigen::Vector3f& normal = roof.normals[i];
    if (normal.y() != 0.0F) {
      roof.texture_coordinates.emplace_back(normal.y() > 0.0F ? 1.0F - share.x() : share.x(), share.z());
    } else if (normal.x() != 0.0F) {
      roof.texture_coordinates.emplace_back(normal.x() > 0.0F ? share.y() : 1.0F - share.y(), share.z());
    } else {
      roof.texture_coordinates.emplace_back(share.y(), share.x());
    }
  }
  return roof;
}

TriangleMesh withFinish(TriangleMesh mesh, const Finish& finish) {
  mesh.materials = {makeMaterial(finish)};
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// On the middle of the front slope, upright on it.
void addScrewCap(TriangleMesh& mesh, const CartonShape& shape, double roof_bottom) {
  const double height_m = 0.4 * shape.cap_diameter_m;
  const Eigen::Vector3d normal = Eigen::Vector3d(shape.roof_height_m, 0.0, shape.depth_m / 2.0).normalized();
  Eigen::Isometry3d T_carton_cap = Eigen::Isometry3d::Identity();
  T_carton_cap.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix();
  T_carton_cap.translation() = Eigen::Vector3d(shape.depth_m / 4.0, 0.0, roof_bottom + shape.roof_height_m / 2.0);
  T_carton_cap.translation() += normal * height_m / 2.0;
  const CylinderShape cap = {
      .radius_m = static_cast<float>(shape.cap_diameter_m / 2.0), .length_m = static_cast<float>(height_m), .segments = 24};
  append(mesh, withFinish(makeCylinder(cap, TextureScale::kWhole), {"cap", shape.cap_rgb}), T_carton_cap);
}

}  // namespace

std::vector<std::string> BoxShape::validate() const {
  ShapeRules rules("object");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).color("body_rgb", body_rgb);
  return rules.messages();
}

TriangleMesh makeSmallBox(const BoxShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  return makePackage(standingBox(shape.width_m, shape.depth_m, shape.height_m), shape.body_rgb);
}

std::vector<std::string> CartonShape::validate() const {
  ShapeRules rules("object");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m);
  rules.length("roof_height_m", roof_height_m).length("seam_m", seam_m).between("cap_diameter_m", cap_diameter_m, 0.0, 1.0);
  rules.require(!(roof_height_m + seam_m >= height_m), "height_m", height_m, "must be more than the roof and the seam");
  rules.require(!(cap_diameter_m > 0.45 * std::min(width_m, depth_m)), "cap_diameter_m", cap_diameter_m,
                "must be at most 0.45 of the width and the depth");
  rules.color("body_rgb", body_rgb).color("roof_rgb", roof_rgb).color("cap_rgb", cap_rgb);
  return rules.messages();
}

TriangleMesh makeCarton(const CartonShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  const double ridge = shape.height_m - shape.seam_m;
  const double roof_bottom = ridge - shape.roof_height_m;
  TriangleMesh mesh = makePackage(standingBox(shape.width_m, shape.depth_m, roof_bottom), shape.body_rgb);
  const Finish roof = {"roof", shape.roof_rgb};
  Eigen::AlignedBox3f attic = standingBox(shape.width_m, shape.depth_m, ridge);
  attic.min().z() = static_cast<float>(roof_bottom);
  append(mesh, withFinish(makeRoof(attic), roof), Eigen::Isometry3d::Identity());
  Eigen::AlignedBox3f seam = standingBox(shape.width_m, 0.03 * shape.depth_m, shape.height_m);
  seam.min().z() = static_cast<float>(ridge - 0.03 * shape.roof_height_m);  // reaches into the slopes
  append(mesh, withFinish(makeBoxBetween(seam, TextureScale::kWhole), roof), Eigen::Isometry3d::Identity());
  if (shape.cap_diameter_m > 0.0) {
    addScrewCap(mesh, shape, roof_bottom);
  }
  return mesh;
}

std::vector<std::string> BookShape::validate() const {
  ShapeRules rules("object");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("board_m", board_m);
  rules.require(!(4.0 * board_m >= std::min({width_m, depth_m, height_m})), "board_m", board_m, "must leave room for the pages");
  rules.color("cover_rgb", cover_rgb).color("pages_rgb", pages_rgb);
  return rules.messages();
}

TriangleMesh makeBook(const BookShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  const auto board_m = static_cast<float>(shape.board_m);
  const Eigen::AlignedBox3f outer = standingBox(shape.width_m, shape.depth_m, shape.height_m);
  const auto plain = [&](const char* face, std::size_t index) {
    std::array<Finish, 6> finishes;
    finishes.fill({"binding", shape.cover_rgb});
    finishes[index] = {face, shape.cover_rgb};
    return finishes;
  };
  Eigen::AlignedBox3f cover = outer;
  cover.min().x() = outer.max().x() - board_m;
  Eigen::AlignedBox3f back = outer;
  back.max().x() = outer.min().x() + board_m;
  Eigen::AlignedBox3f spine = outer;
  spine.max().y() = outer.min().y() + board_m;
  spine.min().x() = back.max().x();
  spine.max().x() = cover.min().x();
  Eigen::AlignedBox3f pages = spine;
  pages.min() += Eigen::Vector3f(0.0F, board_m, board_m);
  pages.max() = Eigen::Vector3f(cover.min().x(), outer.max().y() - board_m, outer.max().z() - board_m);
  TriangleMesh mesh = makeNamedBox(cover, plain("cover", 1));
  append(mesh, makeNamedBox(back, plain("back_cover", 0)), Eigen::Isometry3d::Identity());
  append(mesh, makeNamedBox(spine, plain("spine", 2)), Eigen::Isometry3d::Identity());
  append(mesh, withFinish(makeBoxBetween(pages, TextureScale::kWhole), {"pages", shape.pages_rgb}), Eigen::Isometry3d::Identity());
  return mesh;
}

}  // namespace oikos::model
