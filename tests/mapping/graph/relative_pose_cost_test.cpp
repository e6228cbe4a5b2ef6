// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/relative_pose_cost.h"

#include <gtest/gtest.h>

#include <random>

#include "mapping/graph/pose_block.h"
#include "tests/mapping/graph/numeric_jacobian.h"

namespace oikos::mapping {
namespace {

Eigen::VectorXd block(const Eigen::Isometry3d& T) {
  const PoseBlock b = toPoseBlock(T);
  return Eigen::Map<const Eigen::VectorXd>(b.data(), 7);
}

geometry::Vector6d randomTwist(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  geometry::Vector6d xi;
  for (double& x : xi) {
    x = uniform(random);
  }
  return xi;
}

TEST(RelativePoseCost, IsZeroWhereTheMeasurementHolds) {
  std::mt19937 random(1);
  const Eigen::Isometry3d T_world_from = geometry::expSe3(randomTwist(random, 1.5));
  const Eigen::Isometry3d T_from_to = geometry::expSe3(randomTwist(random, 1.0));
  const RelativePoseCost cost(T_from_to, geometry::Matrix6d::Identity());
  EXPECT_LT(residualsOf(cost, {block(T_world_from), block(T_world_from * T_from_to)}).norm(), 1e-12);
}

TEST(RelativePoseCost, ResidualIsTheLogarithmTimesTheRootOfTheInformation) {
  std::mt19937 random(2);
  const Eigen::Isometry3d T_world_from = geometry::expSe3(randomTwist(random, 1.5));
  const Eigen::Isometry3d T_from_to = geometry::expSe3(randomTwist(random, 1.0));
  const geometry::Vector6d xi = randomTwist(random, 0.3);
  geometry::Matrix6d root = geometry::Matrix6d::Identity();
  root(0, 3) = 2.0;
  root.row(4) *= 7.0;
  const RelativePoseCost cost(T_from_to, root);
  const Eigen::VectorXd r = residualsOf(cost, {block(T_world_from), block(T_world_from * T_from_to * geometry::expSe3(xi))});
  EXPECT_LT((r - root * xi).norm(), 1e-10);
}

/// Exact where the residual is zero; elsewhere the error is of second order in it: |Jr^-1 - I - ad / 2| <= |xi|^2 / 12 and what follows.
TEST(RelativePoseCost, JacobiansAgreeWithDifferences) {
  std::mt19937 random(3);
  for (const double size : {0.0, 0.001, 0.01, 0.05}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Isometry3d T_world_from = geometry::expSe3(randomTwist(random, 1.5));
      const Eigen::Isometry3d T_from_to = geometry::expSe3(randomTwist(random, 0.8));
      const geometry::Vector6d xi = randomTwist(random, size);
      const RelativePoseCost cost(T_from_to, geometry::Matrix6d::Identity());
      const CheckedJacobians checked = checkJacobians(cost, {block(T_world_from), block(T_world_from * T_from_to * geometry::expSe3(xi))});
      const double scale = 1.0 + T_from_to.translation().norm();
      for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_LT((checked.analytic[b] - checked.numeric[b]).norm(), 1e-7 + scale * xi.squaredNorm()) << "block " << b << ", size " << size;
      }
    }
  }
}

}  // namespace
}  // namespace oikos::mapping
