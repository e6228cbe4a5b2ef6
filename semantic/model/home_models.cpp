// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/home_models.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/model/mesh_file.h"
#include "core/model/primitives.h"
#include "core/model/shapes/shape_text.h"

namespace oikos::semantic {

namespace {

using model::ArticulatedModel;
using model::TriangleMesh;

std::shared_ptr<const TriangleMesh> meshOfBoxes(const std::vector<Box>& boxes) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (const Box& box : boxes) {
    append(*mesh, model::makeBox(box.size_m.cast<float>()), box.center.toIsometry());
  }
  return boxes.empty() ? nullptr : mesh;
}

/// All parts where they are when everything is closed.
std::shared_ptr<const TriangleMesh> meshOfWhole(const ArticulatedModel& shape) {
  auto mesh = std::make_shared<TriangleMesh>();
  const std::vector<Eigen::Isometry3d> T_model_parts = model::Kinematics(shape).solve(std::vector<double>(shape.joints.size(), 0.0));
  for (std::size_t i = 0; i < shape.parts.size(); ++i) {
    if (shape.parts[i].mesh_part) {
      append(*mesh, *shape.parts[i].mesh_part, T_model_parts[i]);
    }
  }
  return mesh;
}

std::size_t indexOfPart(const Articulation& articulation, const PartId& id) {
  const auto found = std::find_if(articulation.parts.begin(), articulation.parts.end(), [&](const Part& part) { return part.id == id; });
  OIKOS_CHECK(found != articulation.parts.end());
  return static_cast<std::size_t>(found - articulation.parts.begin());
}

/// The piece of the shape that stands for a part of the object: the base for the base, the others by name.
const model::ModelPart* findShapePart(const ArticulatedModel& shape, const LargeObject& object, const Part& part) {
  if (part.parent.value.empty()) {
    return &shape.parts.front();
  }
  const std::string name = shapePartName(object.id, part.id);
  const auto found = std::find_if(shape.parts.begin(), shape.parts.end(), [&](const model::ModelPart& p) { return p.name == name; });
  return found == shape.parts.end() ? nullptr : &*found;
}

model::ModelJoint jointOf(const Joint& joint, const Articulation& articulation) {
  model::ModelJoint made;
  made.name = joint.id.value;
  made.type = joint.type == JointType::kRevolute ? model::MotionType::kRevolute : model::MotionType::kPrismatic;
  made.parent = static_cast<int>(indexOfPart(articulation, joint.parent));
  made.child = static_cast<int>(indexOfPart(articulation, joint.child));
  made.T_parent_joint = joint.T_parent_joint.toIsometry();
  made.axis_joint = joint.axis_joint;
  made.lower = joint.lower;
  made.upper = joint.upper;
  return made;
}

/// A part that no joint moves hangs on its parent all the same.
void fixLooseParts(const Articulation& articulation, ArticulatedModel& made) {
  for (std::size_t i = 0; i < articulation.parts.size(); ++i) {
    const Part& part = articulation.parts[i];
    const bool is_moved =
        std::any_of(articulation.joints.begin(), articulation.joints.end(), [&](const Joint& j) { return j.child == part.id; });
    if (!part.parent.value.empty() && !is_moved) {
      model::ModelJoint fixed;
      fixed.name = part.id.value;
      fixed.parent = static_cast<int>(indexOfPart(articulation, part.parent));
      fixed.child = static_cast<int>(i);
      made.joints.push_back(std::move(fixed));
    }
  }
}

void addKnobs(const LargeObject& object, const ArticulatedModel* shape, ArticulatedModel& made) {
  for (const Knob& knob : object.articulation->knobs) {
    const std::string name = shapePartName(object.id, PartId{knob.id.value});
    const auto* const part = shape == nullptr ? nullptr : [&]() -> const model::ModelPart* {
      const auto found = std::find_if(shape->parts.begin(), shape->parts.end(), [&](const model::ModelPart& p) { return p.name == name; });
      return found == shape->parts.end() ? nullptr : &*found;
    }();
    model::ModelJoint joint;
    joint.name = knob.id.value;
    joint.type = model::MotionType::kRevolute;
    joint.parent = static_cast<int>(indexOfPart(*object.articulation, knob.part));
    joint.child = static_cast<int>(made.parts.size());
    joint.T_parent_joint = knob.T_part_knob.toIsometry();
    joint.axis_joint = knob.axis_knob;
    joint.lower = -std::numeric_limits<double>::infinity();
    joint.upper = std::numeric_limits<double>::infinity();
    model::ModelKnob made_knob{knob.id.value, joint.child, Eigen::Isometry3d::Identity(), knob.axis_knob, {}};
    for (const KnobState& state : knob.states) {
      made_knob.states.push_back({state.name, state.angle_rad});
    }
    made.knobs.push_back(std::move(made_knob));
    made.parts.push_back({knob.id.value, part == nullptr ? nullptr : part->mesh_part});
    made.joints.push_back(std::move(joint));
  }
}

double currentAngle(const Knob& knob) {
  const auto state = std::find_if(knob.states.begin(), knob.states.end(), [&](const KnobState& s) { return s.name == knob.current; });
  return state == knob.states.end() ? 0.0 : state->angle_rad;
}

std::size_t fixedParts(const Articulation& articulation) {
  return static_cast<std::size_t>(std::count_if(articulation.parts.begin(), articulation.parts.end(), [&](const Part& part) {
    return !part.parent.value.empty() &&
           std::none_of(articulation.joints.begin(), articulation.joints.end(), [&](const Joint& j) { return j.child == part.id; });
  }));
}

/// Without what only rounding has left behind the 12th decimal: it will be written into a file.
double tidied(double value) {
  return std::round(value * 1e12) / 1e12 + 0.0;
}

Pose tidiedPose(const Eigen::Isometry3d& T_a_b) {
  Pose pose = Pose::fromIsometry(T_a_b);
  pose.position_m = pose.position_m.unaryExpr(&tidied);
  return pose;
}

}  // namespace

ArticulatedModel ModelMaker::make(const LargeObject& object) {
  ArticulatedModel made;
  made.name = object.id.value;
  std::optional<ArticulatedModel> shape;
  if (object.shape) {
    shape = makeShape(*object.shape, "shape of '" + object.id.value + "'");
  }
  if (!object.articulation) {
    const Mesh mesh = !object.model.empty() ? meshOf(object.model) : shape ? meshOfWhole(*shape) : meshOfBoxes(object.boxes_object);
    made.parts.push_back({object.id.value, mesh});
    return made;
  }
  const ArticulatedModel* const from = shape ? &*shape : nullptr;
  for (const Part& part : object.articulation->parts) {
    addPart(object, part, from, made);
  }
  for (const Joint& joint : object.articulation->joints) {
    made.joints.push_back(jointOf(joint, *object.articulation));
  }
  for (const Handle& handle : object.articulation->handles) {
    const int part = static_cast<int>(indexOfPart(*object.articulation, handle.part));
    made.handles.push_back({handle.id, part, handle.T_part_handle.toIsometry(), handle.length_m, handle.kind});
  }
  fixLooseParts(*object.articulation, made);
  addKnobs(object, from, made);
  return made;
}

ArticulatedModel ModelMaker::make(const SmallObject& object) {
  ArticulatedModel made;
  made.name = object.id.value;
  Mesh mesh;
  if (!object.model.empty()) {
    mesh = meshOf(object.model);
  } else if (object.shape) {
    mesh = meshOfWhole(makeShape(*object.shape, "shape of '" + object.id.value + "'"));
  } else if (object.box_model) {
    mesh = meshOfBoxes({*object.box_model});
  }
  made.parts.push_back({object.id.value, mesh});
  return made;
}

ModelMaker::Mesh ModelMaker::meshOf(const std::string& file) {
  Mesh& mesh = meshes_[file];
  if (!mesh) {
    mesh = std::make_shared<const TriangleMesh>(model::readMesh(folder_ / file).mesh_model);
  }
  return mesh;
}

void ModelMaker::addPart(const LargeObject& object, const Part& part, const ArticulatedModel* shape, ArticulatedModel& made) {
  Mesh mesh = part.model.empty() ? meshOfBoxes(part.boxes_part) : meshOf(part.model);
  if (const model::ModelPart* const found = shape == nullptr || !part.model.empty() ? nullptr : findShapePart(*shape, object, part)) {
    mesh = found->mesh_part;
  }
  made.parts.push_back({part.id.value, std::move(mesh)});
}

model::Dimensions dimensionsOf(const Shape& shape) {
  model::Dimensions dimensions;
  for (const Property& dimension : shape.dimensions) {
    dimensions.emplace_back(dimension.name, dimension.value);
  }
  return dimensions;
}

ArticulatedModel makeShape(const Shape& shape, const std::string& where) {
  return model::makeShape(shape.kind, dimensionsOf(shape), where);
}

std::vector<double> jointValues(const LargeObject& object) {
  std::vector<double> values;
  if (object.articulation) {
    for (const Joint& joint : object.articulation->joints) {
      values.push_back(joint.value);
    }
    values.resize(values.size() + fixedParts(*object.articulation), 0.0);
    for (const Knob& knob : object.articulation->knobs) {
      values.push_back(currentAngle(knob));
    }
  }
  return values;
}

std::string shapePartName(const ObjectId& object, const PartId& part) {
  const std::string prefix = object.value + "-";
  return part.value.starts_with(prefix) ? part.value.substr(prefix.size()) : part.value;
}

Articulation articulationOf(const ArticulatedModel& shape, const ObjectId& object) {
  const auto idOf = [&](int part) { return object.value + "-" + shape.parts[static_cast<std::size_t>(part)].name; };
  const auto isKnob = [&](int part) {
    return std::any_of(shape.knobs.begin(), shape.knobs.end(), [&](const model::ModelKnob& knob) { return knob.part == part; });
  };
  const auto jointTo = [&](int part) {
    return std::find_if(shape.joints.begin(), shape.joints.end(), [&](const model::ModelJoint& joint) { return joint.child == part; });
  };
  Articulation made;
  for (int i = 0; i < static_cast<int>(shape.parts.size()); ++i) {
    if (!isKnob(i)) {
      const auto joint = jointTo(i);
      made.parts.push_back({{idOf(i)}, {}, {joint == shape.joints.end() ? "" : idOf(joint->parent)}, {}, {}, {}});
    }
  }
  for (const model::ModelJoint& joint : shape.joints) {
    if (!isKnob(joint.child)) {
      const JointType type = joint.type == model::MotionType::kPrismatic ? JointType::kPrismatic : JointType::kRevolute;
      made.joints.push_back({{idOf(joint.child) + "-joint"},
                             type,
                             {idOf(joint.parent)},
                             {idOf(joint.child)},
                             tidiedPose(joint.T_parent_joint),
                             joint.axis_joint,
                             joint.type == model::MotionType::kPrismatic ? tidied(joint.lower) : joint.lower,
                             joint.type == model::MotionType::kPrismatic ? tidied(joint.upper) : joint.upper,
                             0.0,
                             {}});
    }
  }
  for (const model::ModelHandle& handle : shape.handles) {
    made.handles.push_back(
        {object.value + "-" + handle.name, {idOf(handle.part)}, handle.kind, tidiedPose(handle.T_part_handle), handle.length_m, {}});
  }
  for (const model::ModelKnob& knob : shape.knobs) {
    const auto joint = jointTo(knob.part);
    Knob known{{idOf(knob.part)}, {}, {idOf(joint->parent)}, tidiedPose(joint->T_parent_joint), joint->axis_joint, {}, {}, {}};
    for (const model::ModelKnobState& state : knob.states) {
      known.states.push_back({state.name, state.angle_rad});
    }
    known.current = known.states.empty() ? "" : known.states.front().name;
    made.knobs.push_back(std::move(known));
  }
  return made;
}

}  // namespace oikos::semantic
