// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/render/scene.h"
#include "tests/registration/articulated/door_world.h"

namespace oikos::registration {
namespace {

/// A camera at the origin that looks along y at a wall, with a box before its left half if that is known.
struct Wall {
  double at_m = 2.0;
  double box_at_m = 0.0;  ///< its front; 0: none

  [[nodiscard]] render::View view(const camera::PinholeCamera& camera) const {
    render::Scene scene;
    scene.add(cuboid({Eigen::Vector3d(-5.0, at_m, -3.0), Eigen::Vector3d(5.0, at_m + 0.1, 3.0)}), Eigen::Isometry3d::Identity());
    if (box_at_m > 0.0) {
      scene.add(cuboid({Eigen::Vector3d(-5.0, box_at_m, -3.0), Eigen::Vector3d(-0.2, at_m - 0.001, 3.0)}), Eigen::Isometry3d::Identity());
    }
    scene.commit();
    Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
    T_map_camera.linear() << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
    return test::viewOf(scene, camera, T_map_camera);
  }
  [[nodiscard]] Scan scan() const { return makeScan(view(test::kinectCamera()).depth_m, test::kinectCamera(), {}); }
};

/// What is known, settled on what there is, in the middle of the right half.
struct Settled {
  float depth_m = 0.0F;
  float sigma_m = 0.0F;
};
Settled settledAt(const Surroundings& about, int u) {
  const int v = about.depth_m.rows / 2;
  return {about.depth_m.at<float>(v, u), about.sigma_m.at<float>(v, u)};
}
Settled rightOf(const Wall& known, const Wall& true_wall) {
  const Scan scan = true_wall.scan();
  return settledAt(surroundingsOf(known.view(scan.camera), scan), 3 * scan.camera.width / 4);
}

TEST(Surroundings, AWallIsBroughtToItsReadings) {
  for (const double off_m : {-0.025, 0.0, 0.018}) {
    const Settled wall = rightOf({.at_m = 2.0}, {.at_m = 2.0 + off_m});
    EXPECT_NEAR(wall.depth_m, 2.0 + off_m, 1e-3);
    EXPECT_FLOAT_EQ(wall.sigma_m, 0.01F);
  }
}

TEST(Surroundings, ReadingsFarOffAreNotOfIt) {
  for (const double off_m : {-0.3, -0.045, 0.045, 0.3}) {
    const Settled wall = rightOf({.at_m = 2.0}, {.at_m = 2.0 + off_m});
    EXPECT_NEAR(wall.depth_m, 2.0, 1e-4) << off_m;
    EXPECT_FLOAT_EQ(wall.sigma_m, 0.02F);
  }
}

TEST(Surroundings, WhatLiesBeforePartOfAWallDoesNotBringItForward) {
  EXPECT_NEAR(rightOf({.at_m = 2.0}, {.at_m = 2.01, .box_at_m = 1.97}).depth_m, 2.01, 1e-3);
}

TEST(Surroundings, EachSurfaceIsBroughtToItsOwn) {
  const Scan scan = Wall{.at_m = 2.01, .box_at_m = 1.48}.scan();
  const Surroundings about = surroundingsOf(Wall{.at_m = 2.0, .box_at_m = 1.5}.view(scan.camera), scan);
  EXPECT_NEAR(settledAt(about, 3 * scan.camera.width / 4).depth_m, 2.01, 1e-3);
  EXPECT_NEAR(settledAt(about, scan.camera.width / 8).depth_m, 1.48, 1e-3);
}

TEST(Surroundings, AFewReadingsBringNothing) {
  Scan scan = Wall{.at_m = 2.02}.scan();
  for (std::size_t i = 150; i < scan.points.size(); ++i) {
    scan.points[i] = {};
  }
  const Settled wall = settledAt(surroundingsOf(Wall{.at_m = 2.0}.view(scan.camera), scan), 3 * scan.camera.width / 4);
  EXPECT_NEAR(wall.depth_m, 2.0, 1e-4);
  EXPECT_FLOAT_EQ(wall.sigma_m, 0.02F);
}

/// A cupboard in a corner, looked at past its front: at the wall beside it, where its door stands if it is wide open.
struct Corner {
  double wall_m = 0.0;   ///< from the door's hinge to the wall, in truth,
  double known_m = 0.0;  ///< and as it is known; 0: it is not
  double camera_x_m = 1.4;

  [[nodiscard]] JointEstimate doorOpenBy(double rad) const {
    DoorWorld world("cabinet", {{"width_m", "0.6"}, {"hinge", "left"}});
    const JointTree tree(world.model);
    const double hinge_y = tree.axes(Eigen::Isometry3d::Identity(), tree.partPoses({0.0})).at(1).origin_map.y();
    const auto wallAt = [&](double beside_m) {  // the hinge is at the right end of y
      return Eigen::AlignedBox3d(Eigen::Vector3d(-0.4, hinge_y - beside_m - 0.1, 0.0), Eigen::Vector3d(4.0, hinge_y - beside_m, 2.5));
    };
    world.values = {rad};
    world.T_map_model = Eigen::Isometry3d::Identity();
    world.sensor = camera::DepthSensorKind::kKinect1;
    world.obstacles = {{wallAt(wall_m)}};
    world.T_map_camera.translation() = Eigen::Vector3d(camera_x_m, hinge_y + 1.5, 1.0);
    world.T_map_camera.linear() << -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, -1.0, 0.0;
    const Scan scan = world.scan();
    render::Scene known;
    known.add(cuboid(wallAt(known_m)), Eigen::Isometry3d::Identity());
    known.commit();
    const Surroundings about = known_m > 0.0 ? surroundingsOf(test::viewOf(known, scan.camera, world.T_map_camera), scan) : Surroundings();
    return ArticulatedRegistration(world.model, {}).run(scan, world.T_map_camera, world.believed({0.0}), {0.013, 0.5, about}).joints[0];
  }
};

TEST(Surroundings, ADoorIsToldFromTheWallBehindIt) {
  for (const double camera_x_m : {1.4, 1.6}) {
    for (const double wall_m : {0.02, 0.035, 0.05, 0.07}) {
      for (const double off_m : {-0.015, 0.0, 0.02}) {
        const Corner corner = {.wall_m = wall_m, .known_m = wall_m + off_m, .camera_x_m = camera_x_m};
        const JointEstimate shut = corner.doorOpenBy(0.0);
        EXPECT_NE(shut.status, JointStatus::kFound) << wall_m << " " << off_m << ": " << shut.value / kDegree;
        const JointEstimate open = corner.doorOpenBy(88.0 * kDegree);
        EXPECT_EQ(open.status, JointStatus::kFound) << wall_m << " " << off_m;
        EXPECT_NEAR(open.value, 88.0 * kDegree, 0.5 * kDegree) << wall_m << " " << off_m;
      }
    }
  }
}

/// To explain the wall, the unseen cupboard would have to stand closer to it than it is likely to.
TEST(Surroundings, AWallThatNobodyKnowsIsNotADoorOfAPieceThatNobodySees) {
  for (const double camera_x_m : {1.4, 1.6}) {
    for (const double wall_m : {0.04, 0.05, 0.07, 0.1}) {
      const Corner corner = {.wall_m = wall_m, .known_m = 0.0, .camera_x_m = camera_x_m};
      EXPECT_NE(corner.doorOpenBy(0.0).status, JointStatus::kFound) << wall_m;
      EXPECT_EQ(corner.doorOpenBy(88.0 * kDegree).status, JointStatus::kFound) << wall_m;
    }
  }
}

}  // namespace
}  // namespace oikos::registration
