// SPDX-License-Identifier: Apache-2.0
#include "bench/registration/field_model.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "core/render/view.h"

namespace oikos::bench {

namespace {

constexpr float kHidden_m = 0.05F;       ///< so far behind what a picture shows
constexpr float kFacingCos = 0.4F;       ///< a triangle within 66° of an axis belongs to it; the nearest axis is at most 55° off
constexpr float kSlopeTolerance = 0.3F;  ///< a distance grows by 1 a metre; where two surfaces meet in a cell it does not

std::size_t facingOf(const Eigen::Vector3f& normal_part) {
  int axis = 0;
  normal_part.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<std::size_t>(axis) + (normal_part[axis] < 0.0F ? 1 : 0);
}

std::vector<FieldTriangle> facing(const std::vector<FieldTriangle>& triangles, std::size_t way) {
  std::vector<FieldTriangle> some;
  for (const FieldTriangle& triangle : triangles) {
    if ((way % 2 == 0 ? 1.0F : -1.0F) * triangle.normal[static_cast<Eigen::Index>(way / 2)] > kFacingCos) {
      some.push_back(triangle);
    }
  }
  return some;
}

}  // namespace

FieldSight::FieldSight(const render::Scene& scene, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera,
                       const Eigen::Isometry3d& T_map_model)
    : depth_m_(render::renderView(scene, render::CameraRays(camera), {T_map_camera, {}}, {}).depth_m),
      camera_(camera),
      T_camera_model_((T_map_camera.inverse() * T_map_model).cast<float>()) {}

bool FieldSight::hides(const Eigen::Vector3f& point_model) const {
  if (depth_m_.empty()) {
    return false;
  }
  const Eigen::Vector3f point = T_camera_model_ * point_model;
  if (point.z() <= 0.0F) {
    return true;
  }
  const float u = static_cast<float>(camera_.fx) * point.x() / point.z() + static_cast<float>(camera_.cx) + 0.5F;
  const float v = static_cast<float>(camera_.fy) * point.y() / point.z() + static_cast<float>(camera_.cy) + 0.5F;
  if (u < 0.0F || v < 0.0F || u >= static_cast<float>(camera_.width) || v >= static_cast<float>(camera_.height)) {
    return true;
  }
  return depth_m_.at<float>(static_cast<int>(v), static_cast<int>(u)) < point.z() - kHidden_m;  // NaN, beside the model: not hidden
}

FieldModel::FieldModel(const model::ArticulatedModel& model, const std::vector<double>& joint_values, const FieldConfig& config) {
  const std::vector<Eigen::Isometry3d> T_model_part = model::Kinematics(model).solve(joint_values);
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    if (!model.parts[i].mesh_part) {
      continue;
    }
    const std::vector<FieldTriangle> triangles = trianglesOf(*model.parts[i].mesh_part);
    Part part{T_model_part[i].inverse().cast<float>(), {}};
    for (std::size_t way = 0; way < part.facings.size(); ++way) {
      part.facings[way] = DistanceField(facing(triangles, way), way / 2, config);
    }
    for (const FieldTriangle& triangle : triangles) {
      for (const Eigen::Vector3f& corner : triangle.corners) {
        box_model_.extend(T_model_part[i] * corner.cast<double>());
      }
    }
    parts_.push_back(std::move(part));
  }
}

bool FieldModel::find(const Eigen::Vector3f& point_model, const Eigen::Vector3f& normal_model, const FieldSight& sight, const Rules& rules,
                      FieldMatch& match) const {
  const auto min_cos = static_cast<float>(rules.min_normal_cos);
  auto nearest_m = static_cast<float>(rules.gate_m);
  bool is_found = false;
  for (const Part& part : parts_) {
    const Eigen::Vector3f normal_part = part.T_part_model.linear() * normal_model;
    const DistanceField& field = part.facings[facingOf(normal_part)];
    const DistanceField::Sample sample = field.at(part.T_part_model * point_model);
    if (!(std::abs(sample.distance_m) < nearest_m)) {
      continue;
    }
    const float slope = sample.gradient.norm();
    if (std::abs(slope - 1.0F) > kSlopeTolerance || normal_part.dot(sample.gradient) < min_cos * slope) {
      continue;
    }
    const FieldMatch candidate{static_cast<double>(sample.distance_m), part.T_part_model.linear().transpose() * sample.gradient / slope};
    if (!sight.hides(candidate.footOf(point_model))) {
      match = candidate;
      nearest_m = std::abs(sample.distance_m);
      is_found = true;
    }
  }
  return is_found;
}

std::size_t FieldModel::bytes() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) {
    for (const DistanceField& field : part.facings) {
      sum += field.bytes();
    }
  }
  return sum;
}

}  // namespace oikos::bench
