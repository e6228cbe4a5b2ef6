// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/pose_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

#include "core/camera/depth_noise.h"

namespace oikos::mapping {
namespace {

using geometry::Matrix6d;
using geometry::Vector6d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kExact = 1e-9;

Vector6d twist(double x, double y, double z, double rx, double ry, double rz) {
  Vector6d xi;
  xi << x, y, z, rx, ry, rz;
  return xi;
}

struct Noise {
  double pixel_px = 0.0;
  double depth_sigmas = 0.0;
};

class PoseSolverTest : public ::testing::Test {
 protected:
  double normal() { return normal_(random_); }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// A point in view, in the camera that is at `T_map_camera_`.
  Eigen::Vector3d pointInView() { return uniform(1.0, 4.0) * camera_.ray(uniform(10.0, 630.0), uniform(10.0, 470.0)); }

  std::vector<PointSighting> sightings(int count, bool with_depth, const Noise& noise = {}) {
    std::vector<PointSighting> all;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d p = pointInView();
      const Eigen::Vector2d pixel = camera_.project(p) + noise.pixel_px * Eigen::Vector2d(normal(), normal());
      // Noise that is normal in inverse depth, with the deviation that the solver believes in.
      const double inverse_depth = 1.0 / p.z() + noise.depth_sigmas * camera::inverseDepthSigma(p.z()) * normal();
      all.push_back({T_map_camera_ * p, pixel, with_depth ? 1.0 / inverse_depth : kNan, 0.5});
    }
    return all;
  }

  /// Error of the solution as a right perturbation of the truth.
  [[nodiscard]] Vector6d errorOf(const PoseSolution& solution) const {
    return geometry::logSe3(T_map_camera_.inverse() * solution.T_world_camera);
  }

  [[nodiscard]] Eigen::Isometry3d start(const Vector6d& off) const { return T_map_camera_ * geometry::expSe3(off); }

  const camera::PinholeCamera camera_{640, 480, 525.0, 525.0, 319.5, 239.5};
  const Eigen::Isometry3d T_map_camera_ = geometry::expSe3(twist(1.0, -2.0, 0.5, 0.4, -1.1, 0.7));
  const Eigen::Isometry3d T_map_start_ = start(twist(0.05, -0.04, 0.03, 0.03, 0.02, -0.04));

 private:
  std::mt19937_64 random_{11};
  std::normal_distribution<double> normal_;
};

TEST_F(PoseSolverTest, CleanSightingsGiveTheExactPose) {
  for (const bool with_depth : {false, true}) {
    for (const Vector6d& off :
         {twist(0, 0, 0, 0, 0, 0), twist(0.05, -0.04, 0.03, 0.03, 0.02, -0.04), twist(-0.1, 0.1, 0.05, -0.05, 0.06, 0.03)}) {
      const auto seen = sightings(60, with_depth);
      const PoseSolution solution = solvePose(seen, camera_, start(off), {});
      ASSERT_EQ(solution.status, PoseStatus::kConverged);
      EXPECT_LT(errorOf(solution).head<3>().norm(), kExact);
      EXPECT_LT(errorOf(solution).tail<3>().norm(), kExact);
      EXPECT_EQ(solution.inliers, 60);
      EXPECT_EQ(solution.inlier.size(), 60U);
      EXPECT_LT(solution.rms_px, 1e-6);
    }
  }
}

TEST_F(PoseSolverTest, SixSightingsAreEnough) {
  const PoseSolution solution = solvePose(sightings(6, false), camera_, T_map_start_, {});
  ASSERT_EQ(solution.status, PoseStatus::kConverged);
  EXPECT_LT(errorOf(solution).norm(), 1e-8);
}

// With a right Jacobian, Gauss-Newton squares a small error of a clean problem in each step: three steps (one in each gate's turn)
// from a centimetre end far below what linear convergence would reach.
TEST_F(PoseSolverTest, ConvergesQuadratically) {
  PoseSolverConfig config;
  config.max_iterations = 1;
  const PoseSolution solution = solvePose(sightings(80, true), camera_, start(twist(0.003, -0.003, 0.002, 0.002, 0.001, -0.002)), config);
  ASSERT_EQ(solution.status, PoseStatus::kConverged);
  EXPECT_LT(errorOf(solution).norm(), 1e-9);
}

/// The whitened residuals of one sighting for a camera that is off by a right perturbation.
Eigen::Vector3d whitened(const PointSighting& s, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) {
  const Eigen::Vector3d p = T_map_camera.inverse() * s.point_world;
  Eigen::Vector3d r;
  r << (camera.project(p) - s.pixel) / s.pixel_sigma_px, (1.0 / p.z() - 1.0 / s.depth_m) / camera::inverseDepthSigma(s.depth_m);
  return r;
}

TEST_F(PoseSolverTest, CovarianceIsThatOfTheNumericJacobian) {
  constexpr double kStep = 1e-6;
  PoseSolverConfig config;
  config.depth_weight = 1.0;
  const auto seen = sightings(50, true);
  const PoseSolution solution = solvePose(seen, camera_, T_map_start_, config);
  ASSERT_EQ(solution.status, PoseStatus::kConverged);
  Matrix6d information = Matrix6d::Zero();
  for (const PointSighting& s : seen) {
    Eigen::Matrix<double, 3, 6> J;
    for (int k = 0; k < 6; ++k) {
      const Vector6d step = kStep * Vector6d::Unit(k);
      J.col(k) = (whitened(s, camera_, start(step)) - whitened(s, camera_, start(-step))) / (2.0 * kStep);
    }
    information += J.transpose() * J;
  }
  EXPECT_LT((solution.covariance * information - Matrix6d::Identity()).norm(), 1e-4);
}

TEST_F(PoseSolverTest, CovarianceIsCalibrated) {
  constexpr int kTrials = 300;
  for (const bool with_depth : {false, true}) {
    PoseSolverConfig config;
    config.depth_weight = 1.0;
    double mean_normalised = 0.0;  // of xi^T covariance^-1 xi; 6 if the covariance is right
    for (int trial = 0; trial < kTrials; ++trial) {
      const PoseSolution solution = solvePose(sightings(80, with_depth, {0.5, 1.0}), camera_, T_map_start_, config);
      ASSERT_EQ(solution.status, PoseStatus::kConverged);
      const Vector6d xi = errorOf(solution);
      mean_normalised += xi.dot(solution.covariance.inverse() * xi) / kTrials;
      // No trial may be far out: 6 sigma of chi-squared with six degrees of freedom is beyond 50.
      EXPECT_LT(xi.dot(solution.covariance.inverse() * xi), 50.0);
      EXPECT_LT(xi.head<3>().norm(), 6.0 * std::sqrt(solution.covariance.topLeftCorner<3, 3>().trace()));
      EXPECT_LT(xi.tail<3>().norm(), 6.0 * std::sqrt(solution.covariance.bottomRightCorner<3, 3>().trace()));
    }
    // The mean of 300 has a deviation of sqrt(12 / 300) = 0.2; Huber's kernel takes a little information away.
    EXPECT_GT(mean_normalised, 4.8) << (with_depth ? "with depth" : "without depth");
    EXPECT_LT(mean_normalised, 7.2) << (with_depth ? "with depth" : "without depth");
  }
}

// More noise than stated (as much as leaves the gate of 4 sigma alone) is noticed by the residual, and the covariance grows with it.
TEST_F(PoseSolverTest, CovarianceGrowsWithTheResidual) {
  const PoseSolution stated = solvePose(sightings(150, false, {0.5, 0.0}), camera_, T_map_start_, {});
  const PoseSolution more = solvePose(sightings(150, false, {0.8, 0.0}), camera_, T_map_start_, {});
  ASSERT_EQ(more.status, PoseStatus::kConverged);
  EXPECT_NEAR(stated.rms_px, 0.5 * std::sqrt(2.0), 0.1);
  EXPECT_NEAR(more.rms_px, 0.8 * std::sqrt(2.0), 0.15);
  const double growth = std::sqrt(more.covariance.trace() / stated.covariance.trace());
  EXPECT_GT(growth, 1.3);
  EXPECT_LT(growth, 2.2);
}

TEST_F(PoseSolverTest, ThirtyPercentOutliersAreLeftOut) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    auto seen = sightings(100, true, {0.3, 0.5});
    for (std::size_t i = 0; i < 30; ++i) {
      seen[i].pixel += uniform(25.0, 80.0) * Eigen::Vector2d(normal(), normal()).normalized();
    }
    const PoseSolution solution = solvePose(seen, camera_, start(twist(0.02, -0.01, 0.01, 0.01, 0.01, -0.01)), {});
    ASSERT_EQ(solution.status, PoseStatus::kConverged);
    EXPECT_LT(errorOf(solution).head<3>().norm(), 0.004);
    EXPECT_LT(errorOf(solution).tail<3>().norm(), 0.002);
    for (std::size_t i = 0; i < 30; ++i) {
      EXPECT_EQ(solution.inlier[i], 0) << "sighting " << i;
    }
    EXPECT_GE(solution.inliers, 68);
    EXPECT_LE(solution.inliers, 70);
  }
}

TEST_F(PoseSolverTest, WrongDepthAloneMakesAnOutlier) {
  auto seen = sightings(60, true);
  seen[7].depth_m *= 1.5;
  const PoseSolution solution = solvePose(seen, camera_, T_map_start_, {});
  ASSERT_EQ(solution.status, PoseStatus::kConverged);
  EXPECT_EQ(solution.inlier[7], 0);
  EXPECT_EQ(solution.inliers, 59);
}

TEST_F(PoseSolverTest, FewSightingsAreAStatus) {
  const PoseSolution none = solvePose({}, camera_, T_map_start_, {});
  EXPECT_EQ(none.status, PoseStatus::kTooFewSightings);
  EXPECT_TRUE(none.T_world_camera.isApprox(T_map_start_, 1e-15));
  const PoseSolution five = solvePose(sightings(5, true), camera_, T_map_start_, {});
  EXPECT_EQ(five.status, PoseStatus::kTooFewSightings);
  EXPECT_TRUE(five.T_world_camera.isApprox(T_map_start_, 1e-15));
  EXPECT_EQ(five.inlier.size(), 5U);
}

TEST_F(PoseSolverTest, SightingsThatAgreeOnNothingAreTooFew) {
  auto seen = sightings(12, false);
  for (PointSighting& s : seen) {
    s.pixel = {uniform(0.0, 640.0), uniform(0.0, 480.0)};
  }
  const PoseSolution solution = solvePose(seen, camera_, T_map_start_, {});
  EXPECT_NE(solution.status, PoseStatus::kConverged);
}

TEST_F(PoseSolverTest, PointsBehindTheCameraDoNotCount) {
  auto seen = sightings(20, false);
  for (PointSighting& s : seen) {
    s.point_world = T_map_camera_ * Eigen::Vector3d(uniform(-1.0, 1.0), uniform(-1.0, 1.0), -2.0);
  }
  EXPECT_NE(solvePose(seen, camera_, T_map_start_, {}).status, PoseStatus::kConverged);
  auto mixed = sightings(30, false);
  mixed.insert(mixed.end(), seen.begin(), seen.end());
  const PoseSolution solution = solvePose(mixed, camera_, T_map_start_, {});
  ASSERT_EQ(solution.status, PoseStatus::kConverged);
  EXPECT_EQ(solution.inliers, 30);
  EXPECT_LT(errorOf(solution).norm(), kExact);
}

TEST_F(PoseSolverTest, OnePointSeenOftenIsDegenerate) {
  const std::vector<PointSighting> seen(20, sightings(1, false).front());
  EXPECT_EQ(solvePose(seen, camera_, T_map_camera_, {}).status, PoseStatus::kDegenerate);
}

// About the line through all points the camera may turn freely.
TEST_F(PoseSolverTest, PointsOnALineAreDegenerate) {
  auto seen = sightings(20, false);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Eigen::Vector3d p(-0.5 + 0.05 * static_cast<double>(i), 0.2, 2.0);
    seen[i].point_world = T_map_camera_ * p;
    seen[i].pixel = camera_.project(p);
  }
  EXPECT_EQ(solvePose(seen, camera_, T_map_camera_, {}).status, PoseStatus::kDegenerate);
}

TEST_F(PoseSolverTest, OnePlaneIsEnough) {
  auto seen = sightings(40, false);
  for (PointSighting& s : seen) {
    const Eigen::Vector3d p = 2.0 * camera_.ray(uniform(10.0, 630.0), uniform(10.0, 470.0));
    s.point_world = T_map_camera_ * p;
    s.pixel = camera_.project(p);
  }
  const PoseSolution solution = solvePose(seen, camera_, T_map_start_, {});
  ASSERT_EQ(solution.status, PoseStatus::kConverged);
  EXPECT_LT(errorOf(solution).norm(), 1e-8);
}

TEST_F(PoseSolverTest, NanIsNeverAnAnswer) {
  auto nan_point = sightings(20, true);
  nan_point[3].point_world.x() = kNan;
  auto nan_pixel = sightings(20, true);
  nan_pixel[3].pixel.y() = kNan;
  for (const auto& seen : {nan_point, nan_pixel}) {
    const PoseSolution solution = solvePose(seen, camera_, T_map_start_, {});
    EXPECT_EQ(solution.status, PoseStatus::kDegenerate);
    EXPECT_TRUE(solution.T_world_camera.isApprox(T_map_start_, 1e-15));
  }
}

TEST_F(PoseSolverTest, AStartFarAwayDoesNotConvergeToNonsense) {
  const PoseSolution solution = solvePose(sightings(40, true), camera_, start(twist(3.0, 0.0, -8.0, 0.0, 2.5, 0.0)), {});
  EXPECT_TRUE(solution.status != PoseStatus::kConverged || errorOf(solution).norm() < 1e-6);
}

/// Rolling shutter: each row sees the point from where the camera is when it is exposed.
class RollingShutter : public PoseSolverTest {
 protected:
  std::vector<PointSighting> rolling(const Vector6d& velocity) {
    constexpr double kReadout_s = 0.03;
    auto seen = sightings(80, false);
    for (PointSighting& s : seen) {
      for (int repeat = 0; repeat < 10; ++repeat) {  // the row depends on the time and the time on the row
        s.time_s = (s.pixel.y() / camera_.height - 0.5) * kReadout_s;
        s.pixel = camera_.project((T_map_camera_ * geometry::expSe3(s.time_s * velocity)).inverse() * s.point_world);
      }
    }
    return seen;
  }
};

TEST_F(RollingShutter, KnownVelocityGivesThePoseAtTheStamp) {
  const Vector6d velocity = twist(0.4, -0.2, 0.3, 0.3, 0.8, -0.4);
  const auto seen = rolling(velocity);
  const PoseSolution solution = solvePose(seen, camera_, T_map_start_, {}, velocity);
  ASSERT_EQ(solution.status, PoseStatus::kConverged);
  // What is left is of second order in time: (0.95 rad/s * 0.015 s)^2 / 2 = 0.1 mrad.
  EXPECT_LT(errorOf(solution).head<3>().norm(), 3e-4);
  EXPECT_LT(errorOf(solution).tail<3>().norm(), 1e-4);
  EXPECT_EQ(solution.inliers, 80);
}

TEST_F(RollingShutter, IgnoringItCosts) {
  const Vector6d velocity = twist(0.4, -0.2, 0.3, 0.3, 0.8, -0.4);
  const PoseSolution corrected = solvePose(rolling(velocity), camera_, T_map_start_, {}, velocity);
  const PoseSolution ignored = solvePose(rolling(velocity), camera_, T_map_start_, {});
  EXPECT_GT(ignored.rms_px, 10.0 * corrected.rms_px);
  EXPECT_GT(errorOf(ignored).norm(), 10.0 * errorOf(corrected).norm());
}

TEST_F(RollingShutter, AtRestItChangesNothing) {
  const PoseSolution solution = solvePose(rolling(Vector6d::Zero()), camera_, T_map_start_, {}, Vector6d::Zero());
  ASSERT_EQ(solution.status, PoseStatus::kConverged);
  EXPECT_LT(errorOf(solution).norm(), kExact);
}

}  // namespace
}  // namespace oikos::mapping
