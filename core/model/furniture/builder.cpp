// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/model/primitives.h"

namespace oikos::model {

namespace {

constexpr int kRodSides = 12;
constexpr double kPostWidth_m = 0.008;
constexpr double kKnobRadius_m = 0.014;
constexpr double kRecessedHeight_m = 0.03;
constexpr double kDialLength_m = 0.025;

/// The material of this name, added if the mesh has none.
std::uint32_t findOrAddMaterial(TriangleMesh& mesh, const Finish& finish) {
  const auto found =
      std::find_if(mesh.materials.begin(), mesh.materials.end(), [&](const Material& material) { return material.name == finish.name; });
  const auto index = static_cast<std::uint32_t>(found - mesh.materials.begin());
  if (found == mesh.materials.end()) {
    mesh.materials.push_back(makeMaterial(finish));
  }
  return index;
}

Eigen::Isometry3d translationTo(const Eigen::Vector3d& place) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = place;
  return T;
}

Eigen::Vector3d turningAxis(HingeEdge hinge) {
  switch (hinge) {
    case HingeEdge::kLeft:
      return -Eigen::Vector3d::UnitZ();
    case HingeEdge::kRight:
      return Eigen::Vector3d::UnitZ();
    case HingeEdge::kTop:
      return -Eigen::Vector3d::UnitY();
    case HingeEdge::kBottom:
      break;
  }
  return Eigen::Vector3d::UnitY();
}

Eigen::Vector3d hingeOrigin(const Eigen::AlignedBox3d& closed_model, HingeEdge hinge) {
  const Eigen::Vector3d middle = closed_model.center();
  const double face_x = closed_model.max().x();
  switch (hinge) {
    case HingeEdge::kLeft:
      return {face_x, closed_model.min().y(), middle.z()};
    case HingeEdge::kRight:
      return {face_x, closed_model.max().y(), middle.z()};
    case HingeEdge::kTop:
      return {face_x, middle.y(), closed_model.max().z()};
    case HingeEdge::kBottom:
      break;
  }
  return {face_x, middle.y(), closed_model.min().z()};
}

HandleKind kindOf(HandleStyle style) {
  const bool is_bar = style == HandleStyle::kBarVertical || style == HandleStyle::kBarHorizontal;
  return is_bar ? HandleKind::kBar : style == HandleStyle::kKnob ? HandleKind::kKnob : HandleKind::kRecessed;
}

/// With its z along `horizontal` (y of the model) or upwards.
Eigen::Matrix3d gripRotation(bool horizontal) {
  return horizontal ? Eigen::AngleAxisd(-std::numbers::pi / 2.0, Eigen::Vector3d::UnitX()).toRotationMatrix() : Eigen::Matrix3d::Identity();
}

}  // namespace

Eigen::AlignedBox3d boxOf(const Span& x, const Span& y, const Span& z) {
  return {Eigen::Vector3d(x.low_m, y.low_m, z.low_m), Eigen::Vector3d(x.high_m, y.high_m, z.high_m)};
}

double handleReach(HandleStyle style) {
  switch (style) {
    case HandleStyle::kBarVertical:
    case HandleStyle::kBarHorizontal:
      return kBarStandOff_m + kBarRadius_m;
    case HandleStyle::kKnob:
      return kKnobLength_m;
    case HandleStyle::kRecessed:
      return kRecessedProud_m;
    case HandleStyle::kNone:
      break;
  }
  return 0.0;
}

FurnitureBuilder::FurnitureBuilder(std::string name) {
  model_.name = std::move(name);
  model_.parts.push_back({"body", nullptr});
  meshes_part_.emplace_back();
  origins_model_.emplace_back(Eigen::Vector3d::Zero());
}

void FurnitureBuilder::addBox(int part, const Eigen::AlignedBox3d& box_model, const Finish& finish) {
  const Eigen::Vector3d& origin = origins_model_[static_cast<std::size_t>(part)];
  const Eigen::AlignedBox3f box_part((box_model.min() - origin).cast<float>(), (box_model.max() - origin).cast<float>());
  addShape(part, makeBoxBetween(box_part), origin, finish);
}

void FurnitureBuilder::addCushion(int part, const Eigen::AlignedBox3d& box_model, const Finish& finish) {
  const double radius_m = std::min(0.05, 0.35 * box_model.sizes().minCoeff());
  const TriangleMesh shape =
      makeRoundedBox({.size_m = box_model.sizes().cast<float>(), .radius_m = static_cast<float>(radius_m), .steps = 2});
  addShape(part, shape, box_model.center(), finish);
}

void FurnitureBuilder::addRod(int part, const Rod& rod, const Finish& finish) {
  const Eigen::Vector3d along = rod.to_model - rod.from_model;
  Eigen::Isometry3d T_model_shape = translationTo((rod.from_model + rod.to_model) / 2.0);
  T_model_shape.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along).toRotationMatrix();
  const TriangleMesh shape =
      makeCylinder({.radius_m = static_cast<float>(rod.radius_m), .length_m = static_cast<float>(along.norm()), .segments = kRodSides});
  addShape(part, shape, T_model_shape, finish);
}

void FurnitureBuilder::addShape(int part, const TriangleMesh& shape, const Eigen::Vector3d& origin_model, const Finish& finish) {
  addShape(part, shape, translationTo(origin_model), finish);
}

void FurnitureBuilder::addShape(int part, const TriangleMesh& shape, const Eigen::Isometry3d& T_model_shape, const Finish& finish) {
  TriangleMesh& mesh = meshes_part_[static_cast<std::size_t>(part)];
  const std::uint32_t material = findOrAddMaterial(mesh, finish);
  const std::vector<Material> materials = mesh.materials;
  append(mesh, shape, translationTo(-origins_model_[static_cast<std::size_t>(part)]) * T_model_shape);
  mesh.materials = materials;  // one a name, not one a shape
  std::fill(mesh.triangle_materials.end() - static_cast<std::ptrdiff_t>(shape.triangles.size()), mesh.triangle_materials.end(), material);
}

int FurnitureBuilder::addPart(const std::string& name, const ModelJoint& joint) {
  const int part = static_cast<int>(model_.parts.size());
  model_.parts.push_back({name, nullptr});
  model_.joints.push_back(joint);
  model_.joints.back().child = part;
  meshes_part_.emplace_back();
  origins_model_.emplace_back(joint.T_parent_joint.translation());
  return part;
}

int FurnitureBuilder::addTurningPart(const std::string& name, const Hinge& hinge) {
  return addPart(name, {.name = name + "_hinge",
                        .type = MotionType::kRevolute,
                        .T_parent_joint = translationTo(hinge.origin_model),
                        .axis_joint = hinge.axis_model,
                        .upper = hinge.opening_rad});
}

int FurnitureBuilder::addHingedPart(const HingedFront& front) {
  return addTurningPart(front.name, {hingeOrigin(front.closed_model, front.hinge), turningAxis(front.hinge), front.opening_rad});
}

int FurnitureBuilder::addSlidingPart(const std::string& name, const Eigen::Vector3d& origin_model, double travel_m) {
  return addPart(name, {.name = name + "_slide",
                        .type = MotionType::kPrismatic,
                        .T_parent_joint = translationTo(origin_model),
                        .axis_joint = Eigen::Vector3d::UnitX(),
                        .upper = travel_m});
}

void FurnitureBuilder::addHandle(int part, const HandlePlace& place, const Finish& finish) {
  const Eigen::Vector3d& centre = place.centre_model;
  const bool horizontal = place.style != HandleStyle::kBarVertical;
  const Eigen::Vector3d along = horizontal ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d half = along * place.length_m / 2.0;
  Eigen::Vector3d grip = centre;
  if (place.style == HandleStyle::kBarVertical || place.style == HandleStyle::kBarHorizontal) {
    grip.x() += kBarStandOff_m;
    addRod(part, {grip - half, grip + half, kBarRadius_m}, finish);
    for (const double side : {-0.8, 0.8}) {
      const Eigen::Vector3d post = centre + side * half;
      const Eigen::Vector3d corner(0.0, kPostWidth_m / 2.0, kPostWidth_m / 2.0);
      addBox(part, {post - corner, post + corner + Eigen::Vector3d(kBarStandOff_m, 0.0, 0.0)}, finish);
    }
  } else if (place.style == HandleStyle::kKnob) {
    grip.x() += kKnobLength_m / 2.0;
    addRod(part, {centre, centre + Eigen::Vector3d(kKnobLength_m, 0.0, 0.0), kKnobRadius_m}, finish);
  } else if (place.style == HandleStyle::kRecessed) {
    const Eigen::Vector3d corner = half + Eigen::Vector3d(0.0, 0.0, kRecessedHeight_m / 2.0);
    addBox(part, {centre - corner, centre + corner + Eigen::Vector3d(kRecessedProud_m, 0.0, 0.0)}, finish);
  } else {
    return;
  }
  ModelHandle handle{.name = place.name, .part = part, .length_m = {}, .kind = kindOf(place.style)};
  handle.T_part_handle = translationTo(grip);
  handle.T_part_handle.linear() = gripRotation(horizontal);
  handle.length_m = place.style == HandleStyle::kKnob ? 2.0 * kKnobRadius_m : place.length_m;
  enterHandle(part, handle);
}

void FurnitureBuilder::enterHandle(int part, const ModelHandle& handle_model) {
  model_.handles.push_back(handle_model);
  model_.handles.back().part = part;
  model_.handles.back().T_part_handle.translation() -= origins_model_[static_cast<std::size_t>(part)];
}

void FurnitureBuilder::addKnob(const KnobPlace& place, const Finish& finish, const Finish& mark) {
  const int part = addPart(place.name, {.name = place.name + "_turn",
                                        .type = MotionType::kRevolute,
                                        .T_parent_joint = translationTo(place.centre_model),
                                        .axis_joint = -Eigen::Vector3d::UnitX(),
                                        .upper = place.range_rad});
  const Eigen::Vector3d tip = place.centre_model + Eigen::Vector3d(kDialLength_m, 0.0, 0.0);
  addRod(part, {place.centre_model, tip, place.radius_m}, finish);
  const double width_m = 0.15 * place.radius_m;
  const Eigen::Vector3d low(-kDialLength_m * 0.6, -width_m, 0.1 * place.radius_m);
  addBox(part, {tip + low, tip + Eigen::Vector3d(0.0015, width_m, 1.06 * place.radius_m)}, mark);
  ModelKnob knob{.name = place.name, .part = part, .axis_knob = -Eigen::Vector3d::UnitX(), .states = {}};
  for (int state = 0; state < place.state_count; ++state) {
    knob.states.push_back({std::to_string(state), place.range_rad * state / std::max(1, place.state_count - 1)});
  }
  model_.knobs.push_back(knob);
}

ArticulatedModel FurnitureBuilder::build() const {
  ArticulatedModel model = model_;
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    model.parts[part].mesh_part = std::make_shared<const TriangleMesh>(meshes_part_[part]);
  }
  return model;
}

}  // namespace oikos::model
