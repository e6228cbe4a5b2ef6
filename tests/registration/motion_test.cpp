// SPDX-License-Identifier: Apache-2.0
#include "registration/motion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/registration/furniture_scan.h"
#include "tests/support/analytic_room.h"

namespace oikos::registration {
namespace {

Eigen::Isometry3d somewhere() {
  return Eigen::Translation3d(1.0, -2.0, 0.5) * Eigen::AngleAxisd(0.8, Eigen::Vector3d(0.2, 0.1, 1.0).normalized());
}

/// Where a point that is fixed to a part of the scene is, or before a camera that moves, where it would be if the camera had stayed.
Eigen::Vector3d pointOf(const Motion& motion, int part, const Eigen::Vector3d& point_part, const Eigen::Isometry3d& T_map_camera_before) {
  const Eigen::Isometry3d T_camera_part =
      motion.T_map_camera().inverse() * motion.scene().parts()[static_cast<std::size_t>(part)].T_map_part;
  return T_map_camera_before * T_camera_part * point_part;
}

/// Twists are the derivative of where the model's points go before the scan.
void expectTwistsToBeDerivatives(Motion& motion) {
  constexpr double kSmall = 1e-6;
  const Eigen::Isometry3d T_map_camera = motion.T_map_camera();
  const std::vector<double> state = motion.saved();
  const Eigen::Vector3d pivot_map = motion.pivot_map();
  const Eigen::Vector3d point_part(0.1, -0.2, 0.3);
  for (int part = 0; part < static_cast<int>(motion.scene().parts().size()); ++part) {
    const Twists twists = motion.twistsOf(part);
    ASSERT_EQ(twists.cols(), motion.dimension());
    const Eigen::Vector3d before = pointOf(motion, part, point_part, T_map_camera);
    for (int i = 0; i < motion.dimension(); ++i) {
      Step step = Step::Zero(motion.dimension());
      step[i] = kSmall;
      motion.apply(step);
      const Eigen::Vector3d numeric = (pointOf(motion, part, point_part, T_map_camera) - before) / kSmall;
      motion.restore(state);
      const Eigen::Vector3d turn = twists.col(i).tail<3>();
      const Eigen::Vector3d analytic = twists.col(i).head<3>() + turn.cross(before - pivot_map);
      EXPECT_LT((numeric - analytic).norm(), 1e-5) << "part " << part << ", " << motion.freedoms()[static_cast<std::size_t>(i)].name;
    }
  }
}

TEST(CameraMotion, TwistsAreDerivatives) {
  render::Scene scene;
  scene.add(test::believed({"cabinet"}), somewhere(), {0.5});
  scene.commit();
  for (const PoseFreedom freedom : {PoseFreedom::kPlanar, PoseFreedom::kRigid}) {
    CameraMotion motion(scene, test::lookAt({3.0, 1.0, 1.2}, {1.0, -2.0, 0.5}), freedom, {0.1, 0.2, 0.3});
    expectTwistsToBeDerivatives(motion);
  }
}

TEST(ModelMotion, TwistsAreDerivatives) {
  const model::ArticulatedModel cabinet = test::believed({"cabinet", {{"door_count", "2"}}});
  const model::ArticulatedModel drawers = test::believed({"drawer_unit"});
  for (const model::ArticulatedModel* model : {&cabinet, &drawers}) {
    const std::vector<double> half_open(model->joints.size(), 0.2);
    std::vector<int> all_joints(std::min<std::size_t>(2, model->joints.size()));
    std::iota(all_joints.begin(), all_joints.end(), 0);
    for (const ModelMotion::Freedom& freedom :
         {ModelMotion::Freedom{}, {.base = true, .kind = PoseFreedom::kRigid, .joints = all_joints}, {.base = false, .joints = {0}}}) {
      render::Scene scene;
      scene.add(test::believed({"table"}), Eigen::Isometry3d::Identity(), {});
      const int piece = scene.add(*model, somewhere(), half_open);
      ModelMotion motion(scene, piece, *model, test::lookAt({3.0, 1.0, 1.2}, {1.0, -2.0, 0.5}), {somewhere(), half_open}, freedom);
      expectTwistsToBeDerivatives(motion);
    }
  }
}

TEST(ModelMotion, AJointStopsAtItsLimits) {
  const model::ArticulatedModel cabinet = test::believed({"cabinet"});
  render::Scene scene;
  const int piece = scene.add(cabinet, somewhere(), {0.1});
  ModelMotion motion(scene, piece, cabinet, Eigen::Isometry3d::Identity(), {somewhere(), {0.1}}, {.base = false, .joints = {0}});
  ASSERT_EQ(motion.freedoms().size(), 1U);
  EXPECT_TRUE(motion.freedoms()[0].is_turn);
  EXPECT_EQ(motion.freedoms()[0].name, "joint " + cabinet.joints[0].name);
  motion.apply(Step::Constant(1, 100.0));
  EXPECT_EQ(motion.pose().joint_values[0], cabinet.joints[0].upper);
  motion.apply(Step::Constant(1, -100.0));
  EXPECT_EQ(motion.pose().joint_values[0], cabinet.joints[0].lower);
  EXPECT_EQ(motion.pose().T_map_model.matrix(), somewhere().matrix());
}

TEST(Motion, APlanarStepStaysInThePlane) {
  render::Scene scene;
  scene.add(test::believed({"table"}), Eigen::Isometry3d::Identity(), {});
  scene.commit();
  const Eigen::Isometry3d T_map_camera = test::lookAt({2.0, 0.0, 1.3}, {0.0, 0.0, 0.7});
  CameraMotion motion(scene, T_map_camera, PoseFreedom::kPlanar);
  Step step(3);
  step << 0.2, -0.1, 0.3;
  motion.apply(step);
  const Eigen::Isometry3d T_map_after = motion.T_map_camera() * T_map_camera.inverse();
  EXPECT_NEAR(motion.T_map_camera().translation().z(), 1.3, 1e-12);
  EXPECT_LT((T_map_after.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((motion.T_map_camera().translation() - Eigen::Vector3d(2.2, -0.1, 1.3)).norm(), 1e-12);
}

TEST(Motion, RestoringBringsBackEveryBit) {
  const model::ArticulatedModel cabinet = test::believed({"cabinet"});
  render::Scene scene;
  const int piece = scene.add(cabinet, somewhere(), {0.4});
  ModelMotion motion(scene, piece, cabinet, Eigen::Isometry3d::Identity(), {somewhere(), {0.4}}, {.base = true, .joints = {0}});
  const std::vector<double> state = motion.saved();
  motion.apply(Step::Constant(4, 0.05));
  EXPECT_NE(motion.saved(), state);
  motion.restore(state);
  EXPECT_EQ(motion.saved(), state);
  EXPECT_EQ(motion.pose().T_map_model.matrix(), somewhere().matrix());
}

}  // namespace
}  // namespace oikos::registration
