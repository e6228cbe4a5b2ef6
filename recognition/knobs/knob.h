// SPDX-License-Identifier: Apache-2.0
// What is known of a knob before it is looked at.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"

namespace oikos::recognition {

/// A knob on the part that carries it. Turned by an angle, its points are at T_part_knob * AngleAxis(angle, axis_knob) * point_knob.
struct KnobDescription {
  std::string name;
  Eigen::Isometry3d T_part_knob = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis_knob = Eigen::Vector3d::UnitZ();  ///< length 1; towards the viewer or away from him
  std::vector<model::ModelKnobState> states;
  std::shared_ptr<const model::TriangleMesh> mesh_knob;  ///< at angle 0, its mark in a material of its own
};

/// The knob that `model.knobs[index]` names; its `part` is the one that a joint turns. Throws Error{kInput} with the names of model and
/// knob if no joint turns it, or if it has nothing to see.
[[nodiscard]] KnobDescription describeKnob(const model::ArticulatedModel& model, std::size_t index);

/// The disc that a viewer sees of a knob. Frame `face`: the origin on the axis in the height of what stands out farthest, z away from the
/// carrier. It does not turn with the knob.
struct KnobFace {
  Eigen::Isometry3d T_knob_face = Eigen::Isometry3d::Identity();
  double radius_m = 0.0;   ///< of what is farthest from the axis
  double height_m = 0.0;   ///< from the carrier to the face
  double turn_sign = 1.0;  ///< 1: a growing angle turns counter-clockwise for the viewer
};

/// Throws Error{kInput} with the knob's name for a mesh that has no extent about the axis.
[[nodiscard]] KnobFace findFace(const KnobDescription& knob);

}  // namespace oikos::recognition
