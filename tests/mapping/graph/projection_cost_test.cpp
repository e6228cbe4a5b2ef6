// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/projection_cost.h"

#include <gtest/gtest.h>

#include <random>

#include "mapping/graph/pose_block.h"
#include "tests/mapping/graph/numeric_jacobian.h"

namespace oikos::mapping {
namespace {

constexpr camera::PinholeCamera kCamera{640, 480, 525.0, 520.0, 319.5, 239.5};

Eigen::VectorXd block(const Eigen::Isometry3d& T) {
  const PoseBlock b = toPoseBlock(T);
  return Eigen::Map<const Eigen::VectorXd>(b.data(), 7);
}

Eigen::VectorXd scalar(double value) {
  return Eigen::VectorXd::Constant(1, value);
}

geometry::Vector6d randomTwist(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  geometry::Vector6d xi;
  for (double& x : xi) {
    x = uniform(random);
  }
  return xi;
}

struct Case {
  Sighting sighting;
  std::vector<Eigen::VectorXd> blocks;
};

/// Two views of one place, the residual a few pixels, both cameras in motion.
Case randomCase(std::mt19937& random, double readout_s) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Case c;
  c.sighting.host_px = {100.0 + 440.0 * uniform(random), 80.0 + 320.0 * uniform(random)};
  c.sighting.host_velocity = randomTwist(random, 1.0);
  c.sighting.seen_velocity = randomTwist(random, 1.0);
  c.sighting.inverse_sigma_px = 2.0;
  c.sighting.measured_inverse_depth = 0.5;
  c.sighting.inverse_sigma_inverse_depth = 30.0;
  const double inverse_depth = 0.3 + 0.7 * uniform(random);
  const Eigen::Isometry3d T_world_host = geometry::expSe3(randomTwist(random, 1.5));
  const Eigen::Isometry3d T_host_seen = geometry::expSe3(randomTwist(random, 0.15));
  const Eigen::Vector3d point_host = kCamera.ray(c.sighting.host_px.x(), c.sighting.host_px.y()) / inverse_depth;
  c.sighting.seen_px = kCamera.project(T_host_seen.inverse() * point_host) + Eigen::Vector2d(3.0, -2.0);
  c.blocks = {block(T_world_host), block(T_world_host * T_host_seen), scalar(inverse_depth), scalar(readout_s)};
  return c;
}

TEST(SightingCost, JacobiansAgreeWithDifferences) {
  std::mt19937 random(1);
  for (const double readout_s : {0.0, 0.02, -0.01}) {
    for (int trial = 0; trial < 50; ++trial) {
      const Case c = randomCase(random, readout_s);
      const CheckedJacobians checked = checkJacobians(SightingCost(c.sighting, kCamera), c.blocks);
      for (std::size_t b = 0; b < 4; ++b) {
        const double scale = 1.0 + checked.numeric[b].norm();
        EXPECT_LT((checked.analytic[b] - checked.numeric[b]).norm(), 1e-5 * scale) << "block " << b << ", read-out " << readout_s;
      }
    }
  }
}

TEST(SightingCost, ResidualsAreReprojectionAndInverseDepth) {
  Sighting s;
  s.host_px = {319.5, 239.5};  // the optical axis
  s.seen_px = {300.0, 250.0};
  s.host_velocity.setZero();
  s.seen_velocity.setZero();
  s.inverse_sigma_px = 2.0;
  s.measured_inverse_depth = 0.4;
  s.inverse_sigma_inverse_depth = 10.0;
  Eigen::Isometry3d T_world_seen = Eigen::Isometry3d::Identity();
  T_world_seen.translation().x() = 0.1;
  const Eigen::VectorXd r =
      residualsOf(SightingCost(s, kCamera), {block(Eigen::Isometry3d::Identity()), block(T_world_seen), scalar(0.5), scalar(0.0)});
  EXPECT_NEAR(r[0], 2.0 * (319.5 - 525.0 * 0.1 / 2.0 - 300.0), 1e-9);
  EXPECT_NEAR(r[1], 2.0 * (239.5 - 250.0), 1e-9);
  EXPECT_NEAR(r[2], 10.0 * (0.5 - 0.4), 1e-9);
}

/// The row is exposed (y / height - 0.5) * read-out after the stamp, while the camera moves.
TEST(SightingCost, TheReadOutTimeMovesTheCameraRowByRow) {
  Sighting s;
  s.host_px = {319.5, 239.5};
  s.host_velocity.setZero();
  s.seen_velocity.setZero();
  s.seen_velocity.x() = 1.0;   // metres a second to the right
  s.seen_px = {319.5, 480.0};  // half a read-out after the stamp
  const Eigen::Isometry3d I = Eigen::Isometry3d::Identity();
  const SightingCost cost(s, kCamera);
  const Eigen::VectorXd still = residualsOf(cost, {block(I), block(I), scalar(0.5), scalar(0.0)});
  const Eigen::VectorXd moving = residualsOf(cost, {block(I), block(I), scalar(0.5), scalar(0.02)});
  EXPECT_NEAR(moving[0] - still[0], -525.0 * 0.01 / 2.0, 1e-9);
  EXPECT_NEAR(moving[1], still[1], 1e-9);
}

TEST(SightingCost, APlaceBehindTheCameraIsAConstantWithoutPull) {
  std::mt19937 random(2);
  Case c = randomCase(random, 0.0);
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear() = Eigen::AngleAxisd(3.1, Eigen::Vector3d::UnitY()).toRotationMatrix();
  c.blocks[0] = block(Eigen::Isometry3d::Identity());
  c.blocks[1] = block(turned);
  const CheckedJacobians checked = checkJacobians(SightingCost(c.sighting, kCamera), c.blocks);
  EXPECT_TRUE(checked.residuals.allFinite());
  for (const Eigen::MatrixXd& J : checked.analytic) {
    EXPECT_EQ(J.norm(), 0.0);
  }
}

TEST(RightPerturbedPose, MinusUndoesPlus) {
  std::mt19937 random(3);
  const RightPerturbedPose manifold;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd pose = block(geometry::expSe3(randomTwist(random, 1.5)));
    const geometry::Vector6d xi = randomTwist(random, 0.8);
    Eigen::VectorXd moved(7);
    geometry::Vector6d back;
    manifold.Plus(pose.data(), xi.data(), moved.data());
    manifold.Minus(moved.data(), pose.data(), back.data());
    EXPECT_LT((back - xi).norm(), 1e-10);
    EXPECT_NEAR(moved.tail<4>().norm(), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace oikos::mapping
