// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/knob.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace oikos::recognition {

KnobDescription describeKnob(const model::ArticulatedModel& model, std::size_t index) {
  const model::ModelKnob& knob = model.knobs.at(index);
  const auto joint =
      std::find_if(model.joints.begin(), model.joints.end(), [&](const model::ModelJoint& j) { return j.child == knob.part; });
  if (joint == model.joints.end()) {
    throw base::Error(base::ErrorCode::kInput, "knob '" + knob.name + "' is not turned by any joint", model.name);
  }
  const auto& mesh_part = model.parts.at(static_cast<std::size_t>(knob.part)).mesh_part;
  if (!mesh_part || mesh_part->empty()) {
    throw base::Error(base::ErrorCode::kInput, "knob '" + knob.name + "' has no mesh: give it a model", model.name);
  }
  model::TriangleMesh mesh_knob;
  model::append(mesh_knob, *mesh_part, knob.T_part_knob.inverse());
  return {knob.name, joint->T_parent_joint * knob.T_part_knob, knob.axis_knob, knob.states,
          std::make_shared<const model::TriangleMesh>(std::move(mesh_knob))};
}

KnobFace findFace(const KnobDescription& knob) {
  const Eigen::Vector3d axis = knob.axis_knob.normalized();
  double low = 0.0;  // the carrier is at the knob's origin
  double high = 0.0;
  double radius_m = 0.0;
  for (const Eigen::Vector3f& vertex : knob.mesh_knob->vertices) {
    const Eigen::Vector3d point = vertex.cast<double>();
    const double along = point.dot(axis);
    low = std::min(low, along);
    high = std::max(high, along);
    radius_m = std::max(radius_m, (point - along * axis).norm());
  }
  KnobFace face;
  face.turn_sign = high >= -low ? 1.0 : -1.0;
  face.height_m = std::max(high, -low);
  face.radius_m = radius_m;
  if (!(face.height_m > 1e-4 && face.radius_m > 1e-3)) {
    throw base::Error(base::ErrorCode::kInput, "knob '" + knob.name + "' has no extent about its axis: expected 1 mm at least");
  }
  const Eigen::Vector3d outwards = face.turn_sign * axis;
  face.T_knob_face.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), outwards).toRotationMatrix();
  face.T_knob_face.translation() = face.height_m * outwards;
  return face;
}

}  // namespace oikos::recognition
