// SPDX-License-Identifier: Apache-2.0
// Registration of a model to a scan on the distance fields of its parts.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "bench/registration/field_model.h"
#include "core/render/scene.h"
#include "registration/align.h"
#include "registration/scan.h"

namespace oikos::bench {

/// Where registration starts: a piece of a scene that holds nothing else. The scene is moved.
struct FieldStart {
  render::Scene& scene;
  int piece;
  std::vector<double> joint_values;
  Eigen::Isometry3d T_map_model;
  Eigen::Isometry3d T_map_camera;
};

struct FieldAlignment {
  Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
  int inliers = 0;  ///< of the last step: within the robust kernel
  int lookups = 0;  ///< of all points about the model
};

/// Gauss-Newton over x, y and yaw (map) on the distances of the scan's points, which are looked up anew after each step that is longer
/// than a centimetre and before the end; levels, gates, weights and limits of a step are those of registration::align(). No outlines, and
/// no verdict on what was found.
[[nodiscard]] FieldAlignment alignOnFields(const FieldModel& fields, const FieldStart& start, const registration::Scan& scan,
                                           const registration::AlignConfig& config);

}  // namespace oikos::bench
