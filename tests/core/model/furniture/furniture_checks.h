// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/core/model/mesh_checks.h"

namespace oikos::test {

inline void expectNear(const Eigen::Vector3d& found, const Eigen::Vector3d& expected, double tolerance) {
  EXPECT_TRUE((found - expected).cwiseAbs().maxCoeff() <= tolerance) << found.transpose() << " instead of " << expected.transpose();
}

/// Accepted by the kinematics, closed, outward, with textures and named materials, opening by positive values, of a bearable size.
inline void expectSound(const model::ArticulatedModel& model) {
  const model::Kinematics kinematics(model);
  EXPECT_EQ(kinematics.root(), 0);
  std::size_t triangles = 0;
  for (const model::ModelPart& part : model.parts) {
    SCOPED_TRACE(model.name + "/" + part.name);
    const model::TriangleMesh& mesh = *part.mesh_part;
    triangles += mesh.triangles.size();
    EXPECT_EQ(openEdges(mesh), 0);
    EXPECT_GT(volumeM3(mesh), 0.0);
    EXPECT_EQ(wrongNormals(mesh, 0.8), 0);
    EXPECT_EQ(mesh.texture_coordinates.size(), mesh.vertices.size());
    for (const model::Material& material : mesh.materials) {
      EXPECT_FALSE(material.name.empty());
    }
  }
  EXPECT_LT(triangles, 3000U) << model.name;
  for (const model::ModelJoint& joint : model.joints) {
    EXPECT_EQ(joint.lower, 0.0);
    EXPECT_GT(joint.upper, 0.0);
  }
}

/// Both ways: vertices of the one part within the boxes of the other by more than `kTouch_m`.
inline bool partsCollide(const model::ArticulatedModel& model, const std::vector<double>& joint_values, std::size_t one,
                         std::size_t other) {
  constexpr double kTouch_m = 1e-6;
  const auto T_model_part = model::Kinematics(model).solve(joint_values);
  const auto hits = [&](std::size_t moving, std::size_t still) {
    const Eigen::Isometry3d T_still_moving = T_model_part[still].inverse() * T_model_part[moving];
    const auto boxes = boxesOf(*model.parts[still].mesh_part);
    for (const Eigen::Vector3f& vertex : model.parts[moving].mesh_part->vertices) {
      const Eigen::Vector3d place = T_still_moving * vertex.cast<double>();
      for (const Eigen::AlignedBox3d& box : boxes) {
        if (((place - box.min()).array() > kTouch_m).all() && ((box.max() - place).array() > kTouch_m).all()) {
          return true;
        }
      }
    }
    return false;
  };
  return hits(one, other) || hits(other, one);
}

/// All joints together, in steps of 10 degrees or a tenth of their travel: no part enters the base or another part.
inline void expectNoCollision(const model::ArticulatedModel& model) {
  constexpr double kStep_rad = 3.14159265358979 / 18.0;
  for (int step = 0; step <= 18; ++step) {
    std::vector<double> values;
    for (const model::ModelJoint& joint : model.joints) {
      const double wanted = joint.type == model::MotionType::kRevolute ? step * kStep_rad : 0.1 * step * joint.upper;
      values.push_back(std::min(wanted, joint.upper));
    }
    for (std::size_t one = 0; one < model.parts.size(); ++one) {
      for (std::size_t other = 0; other < one; ++other) {
        EXPECT_FALSE(partsCollide(model, values, one, other))
            << model.parts[one].name << " enters " << model.parts[other].name << " at step " << step;
      }
    }
  }
}

}  // namespace oikos::test
