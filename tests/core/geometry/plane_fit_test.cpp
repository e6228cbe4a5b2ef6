// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/plane_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace oikos::geometry {
namespace {

TEST(PlaneFit, FindsATiltedPlaneFarFromTheOriginExactly) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.2, -0.3, 0.9).normalized();
  const Eigen::Vector3d along = normal.unitOrthogonal();
  const Eigen::Vector3d across = normal.cross(along);
  PlaneFit fit;
  for (int i = -5; i <= 5; ++i) {
    for (int j = -2; j <= 2; ++j) {
      fit.add(100.0 * normal + 0.3 * i * along + 0.1 * j * across);
    }
  }
  const PlaneFitResult result = fit.solve();
  ASSERT_EQ(result.status, PlaneFitStatus::kFitted);
  EXPECT_EQ(result.points, 55);
  EXPECT_NEAR(std::fabs(result.plane.normal.dot(normal)), 1.0, 1e-9);
  EXPECT_NEAR(std::fabs(result.plane.offset_m), 100.0, 1e-9);
  EXPECT_NEAR(result.rms_m, 0.0, 1e-6);
  EXPECT_NEAR((result.centroid - 100.0 * normal).norm(), 0.0, 1e-9);
  EXPECT_NEAR(result.width_m, 0.1 * std::sqrt(2.0), 1e-6);  // of -2 … 2
}

TEST(PlaneFit, RmsIsThatOfTheDistances) {
  PlaneFit fit;
  for (int i = 0; i < 4; ++i) {
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        fit.add({x, y, i % 2 == 0 ? 0.01 : -0.01});
      }
    }
  }
  EXPECT_NEAR(fit.solve().rms_m, 0.01, 1e-9);
}

TEST(PlaneFit, TwoPointsAreTooFew) {
  PlaneFit fit;
  fit.add({0, 0, 0});
  fit.add({1, 0, 0});
  EXPECT_EQ(fit.solve().status, PlaneFitStatus::kTooFewPoints);
}

TEST(PlaneFit, PointsOnALineOrInOnePlaceAreDegenerate) {
  PlaneFit line;
  PlaneFit place;
  for (int i = 0; i < 10; ++i) {
    line.add(Eigen::Vector3d(1.0, 2.0, 3.0) * i);
    place.add({1.0, 2.0, 3.0});
  }
  EXPECT_EQ(line.solve().status, PlaneFitStatus::kDegenerate);
  EXPECT_EQ(place.solve().status, PlaneFitStatus::kDegenerate);
}

TEST(PlaneFit, NanIsNeverAFit) {
  PlaneFit fit;
  fit.add({0, 0, 0});
  fit.add({1, 0, 0});
  fit.add({0, 1, std::nan("")});
  EXPECT_NE(fit.solve().status, PlaneFitStatus::kFitted);
}

}  // namespace
}  // namespace oikos::geometry
