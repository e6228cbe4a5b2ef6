// SPDX-License-Identifier: Apache-2.0
// A model as distance fields of its parts.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "bench/registration/distance_field.h"
#include "core/camera/pinhole_camera.h"
#include "core/model/articulated_model.h"
#include "core/render/scene.h"

namespace oikos::bench {

/// A scan's point before the surface of the model that is nearest of those that face its way.
struct FieldMatch {
  double distance_m = 0.0;  ///< positive in front
  Eigen::Vector3f normal_model = Eigen::Vector3f::Zero();

  [[nodiscard]] Eigen::Vector3f footOf(const Eigen::Vector3f& point_model) const {
    return point_model - static_cast<float>(distance_m) * normal_model;
  }
};

/// What can be seen of the model from the camera: one picture, kept while the model moves a little.
class FieldSight {
 public:
  FieldSight() = default;  ///< nothing is hidden
  /// `scene`: the model, where `T_map_model` has it.
  FieldSight(const render::Scene& scene, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera,
             const Eigen::Isometry3d& T_map_model);

  /// Whether the model itself is in front of a point of its surface, or that point is out of the picture.
  [[nodiscard]] bool hides(const Eigen::Vector3f& point_model) const;

 private:
  cv::Mat depth_m_;
  camera::PinholeCamera camera_;
  Eigen::Isometry3f T_camera_model_ = Eigen::Isometry3f::Identity();
};

/// Fields of the parts of a model whose joints stay, six a part, one for each way that a surface can face. Immutable.
class FieldModel {
 public:
  /// Throws what Kinematics throws.
  FieldModel(const model::ArticulatedModel& model, const std::vector<double>& joint_values, const FieldConfig& config);

  struct Rules {
    double gate_m = 0.05;
    double min_normal_cos = 0.76;
  };
  /// False: no surface within the gate that faces as the point's normal does and that can be seen.
  bool find(const Eigen::Vector3f& point_model, const Eigen::Vector3f& normal_model, const FieldSight& sight, const Rules& rules,
            FieldMatch& match) const;

  [[nodiscard]] const Eigen::AlignedBox3d& box_model() const { return box_model_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Part {
    Eigen::Isometry3f T_part_model = Eigen::Isometry3f::Identity();
    std::array<DistanceField, 6> facings;  ///< +x, -x, +y, … of the part's frame
  };
  std::vector<Part> parts_;
  Eigen::AlignedBox3d box_model_;
};

}  // namespace oikos::bench
