// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/relative_motion.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/camera/depth_noise.h"

namespace oikos::mapping {
namespace {

using geometry::Matrix6d;
using geometry::Vector6d;

Vector6d twist(double x, double y, double z, double rx, double ry, double rz) {
  Vector6d xi;
  xi << x, y, z, rx, ry, rz;
  return xi;
}

struct Scene {
  Features a;
  Features b;
  std::vector<FeatureMatch> matches;
};

class RelativeMotionTest : public ::testing::Test {
 protected:
  double normal() { return normal_(random_); }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  void addPair(Scene& scene, const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b) const {
    scene.a.point_camera.push_back(point_a);
    scene.a.pixel.push_back(camera_.project(point_a));
    scene.b.point_camera.push_back(point_b);
    scene.b.pixel.push_back(point_b.z() > 0.1 ? camera_.project(point_b) : Eigen::Vector2d::Zero());
    scene.matches.push_back({scene.a.size() - 1, scene.b.size() - 1, 0});
  }

  /// Points in view of both cameras, each matched to itself.
  Scene scene(int count, const Eigen::Isometry3d& T_a_b) {
    Scene scene;
    while (static_cast<int>(scene.matches.size()) < count) {
      const Eigen::Vector3d point_a = uniform(1.0, 4.0) * camera_.ray(uniform(10.0, 630.0), uniform(10.0, 470.0));
      const Eigen::Vector3d point_b = T_a_b.inverse() * point_a;
      if (point_b.z() > 0.3) {
        addPair(scene, point_a, point_b);
      }
    }
    return scene;
  }

  /// Gives the first `count` matches other partners.
  static void confuse(Scene& scene, std::size_t count) {
    const int first = scene.matches.front().b;
    for (std::size_t k = 0; k + 1 < count; ++k) {
      scene.matches[k].b = scene.matches[k + 1].b;
    }
    scene.matches[count - 1].b = first;
  }

  [[nodiscard]] RelativeMotion estimate(const Scene& scene, std::uint64_t seed = 1) const {
    return estimateMotion(scene.a, scene.b, scene.matches, camera_, config_, seed);
  }

  const camera::PinholeCamera camera_{640, 480, 525.0, 525.0, 319.5, 239.5};
  const RelativeMotionConfig config_;
  const Eigen::Isometry3d T_a_b_ = geometry::expSe3(twist(0.2, -0.1, 0.3, 0.1, -0.2, 0.15));

 private:
  std::mt19937_64 random_{5};
  std::normal_distribution<double> normal_;
};

TEST_F(RelativeMotionTest, FindsTheMotionAmongSixtyPercentWrongMatches) {
  for (const Eigen::Isometry3d& T_a_b : {T_a_b_, T_a_b_.inverse(), Eigen::Isometry3d::Identity()}) {
    Scene noisy = scene(200, T_a_b);
    for (Eigen::Vector2d& px : noisy.a.pixel) {
      px += 0.5 * Eigen::Vector2d(normal(), normal());
    }
    confuse(noisy, 120);
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const RelativeMotion motion = estimate(noisy, seed);
      ASSERT_EQ(motion.status, MotionStatus::kConverged);
      const Vector6d error = geometry::logSe3(T_a_b.inverse() * motion.T_a_b);
      // 80 sightings of 0.5 px at 525 px and about 2.5 m: 0.5 / 525 / sqrt(80) * 2.5 m = 0.3 mm, times 6.
      EXPECT_LT(error.head<3>().norm(), 0.002);
      EXPECT_LT(error.tail<3>().norm(), 0.001);
      EXPECT_GE(motion.inlier.size(), 80U);
      EXPECT_LE(motion.inlier.size(), 84U);  // a wrong one may agree by chance
      EXPECT_NEAR(motion.rms_px, 0.5 * std::sqrt(2.0), 0.25);
    }
  }
}

TEST_F(RelativeMotionTest, CleanMatchesGiveTheExactMotion) {
  const RelativeMotion motion = estimate(scene(60, T_a_b_));
  ASSERT_EQ(motion.status, MotionStatus::kConverged);
  const Vector6d error = geometry::logSe3(T_a_b_.inverse() * motion.T_a_b);
  EXPECT_LT(error.head<3>().norm(), 1e-9);
  EXPECT_LT(error.tail<3>().norm(), 1e-9);
  EXPECT_EQ(motion.inlier.size(), 60U);
  EXPECT_TRUE(std::is_sorted(motion.inlier.begin(), motion.inlier.end()));
}

TEST_F(RelativeMotionTest, SwappingTheImagesInvertsTheMotion) {
  Scene forward = scene(100, T_a_b_);
  confuse(forward, 50);
  Scene backward{forward.b, forward.a, {}};
  for (const FeatureMatch& match : forward.matches) {
    backward.matches.push_back({match.b, match.a, match.distance});
  }
  const RelativeMotion there = estimate(forward);
  const RelativeMotion back = estimate(backward);
  ASSERT_EQ(there.status, MotionStatus::kConverged);
  ASSERT_EQ(back.status, MotionStatus::kConverged);
  EXPECT_LT(geometry::logSe3(there.T_a_b * back.T_a_b).norm(), 1e-8);
}

TEST_F(RelativeMotionTest, TooFewMatches) {
  EXPECT_EQ(estimate({}).status, MotionStatus::kTooFewMatches);
  const RelativeMotion motion = estimate(scene(config_.min_inliers - 1, T_a_b_));
  EXPECT_EQ(motion.status, MotionStatus::kTooFewMatches);
  EXPECT_TRUE(motion.T_a_b.isApprox(Eigen::Isometry3d::Identity()));
}

TEST_F(RelativeMotionTest, TooFewInliers) {
  Scene wrong = scene(100, T_a_b_);
  confuse(wrong, 100);
  EXPECT_EQ(estimate(wrong).status, MotionStatus::kTooFewInliers);
}

// Enough inliers, but a small share of the matches: more likely a look-alike than the place.
TEST_F(RelativeMotionTest, TooSmallAShareOfInliers) {
  Scene mostly_wrong = scene(200, T_a_b_);
  confuse(mostly_wrong, 155);
  const RelativeMotion motion = estimate(mostly_wrong);
  EXPECT_EQ(motion.status, MotionStatus::kTooFewInliers);
  EXPECT_GE(static_cast<int>(motion.inlier.size()), config_.min_inliers);
}

TEST_F(RelativeMotionTest, TooLittleSpread) {
  Scene corner;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d point_a = uniform(1.0, 4.0) * camera_.ray(uniform(250.0, 310.0), uniform(200.0, 260.0));
    addPair(corner, point_a, T_a_b_.inverse() * point_a);
  }
  const RelativeMotion motion = estimate(corner);
  EXPECT_EQ(motion.status, MotionStatus::kTooLittleSpread);
  EXPECT_LT(motion.spread, config_.min_spread);
  EXPECT_GT(motion.spread, 0.0);
}

// A uniform spread over a rectangle of w x h: the 2-sigma ellipse has the area 4 pi (w h) / 12.
TEST_F(RelativeMotionTest, SpreadIsTheEllipsesShareOfTheImage) {
  const RelativeMotion motion = estimate(scene(400, Eigen::Isometry3d::Identity()));
  ASSERT_EQ(motion.status, MotionStatus::kConverged);
  EXPECT_NEAR(motion.spread, 3.14159265358979 / 3.0 * 620.0 * 460.0 / (640.0 * 480.0), 0.1);
}

TEST_F(RelativeMotionTest, MatchesOnALineAreNoMotion) {
  Scene line;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d point_a(-1.0 + 0.03 * i, 0.2, 2.0);
    addPair(line, point_a, T_a_b_.inverse() * point_a);
  }
  EXPECT_NE(estimate(line).status, MotionStatus::kConverged);
}

TEST_F(RelativeMotionTest, TheSameSeedGivesTheSameBits) {
  Scene noisy = scene(150, T_a_b_);
  for (Eigen::Vector2d& px : noisy.a.pixel) {
    px += 0.8 * Eigen::Vector2d(normal(), normal());
  }
  confuse(noisy, 90);
  const RelativeMotion first = estimate(noisy, 42);
  const RelativeMotion again = estimate(noisy, 42);
  EXPECT_EQ(first.T_a_b.matrix(), again.T_a_b.matrix());
  EXPECT_EQ(first.covariance, again.covariance);
  EXPECT_EQ(first.inlier, again.inlier);
  const RelativeMotion other = estimate(noisy, 43);
  EXPECT_LT(geometry::logSe3(first.T_a_b.inverse() * other.T_a_b).norm(), 1e-3);
}

// Monte Carlo with one camera far behind the other: a covariance of the wrong side, or of the inverse motion, would be far from the
// scatter of the estimates.
TEST_F(RelativeMotionTest, CovarianceIsOfTheRightPerturbation) {
  constexpr int kTrials = 250;
  const Eigen::Isometry3d T_a_b = geometry::expSe3(twist(0.5, 0.3, -3.0, 0.1, -0.3, 0.1));
  const Scene clean = scene(100, T_a_b);
  Matrix6d scatter = Matrix6d::Zero();
  Matrix6d stated = Matrix6d::Zero();
  double mean_normalised = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Scene noisy = clean;
    for (std::size_t i = 0; i < noisy.a.pixel.size(); ++i) {
      noisy.a.pixel[i] += 0.9 * Eigen::Vector2d(normal(), normal());
      Eigen::Vector3d& p = noisy.a.point_camera[i];
      p *= 1.0 / (p.z() * (1.0 / p.z() + camera::inverseDepthSigma(p.z()) * normal()));
    }
    const RelativeMotion motion = estimate(noisy);
    ASSERT_EQ(motion.status, MotionStatus::kConverged);
    const Vector6d xi = geometry::logSe3(T_a_b.inverse() * motion.T_a_b);
    scatter += xi * xi.transpose() / kTrials;
    stated += motion.covariance / kTrials;
    mean_normalised += xi.dot(motion.covariance.inverse() * xi) / kTrials;
  }
  EXPECT_GT(mean_normalised, 4.0);
  EXPECT_LT(mean_normalised, 7.5);
  for (int k = 0; k < 6; ++k) {
    const double ratio = std::sqrt(scatter(k, k) / stated(k, k));
    EXPECT_GT(ratio, 0.75) << "parameter " << k;
    EXPECT_LT(ratio, 1.25) << "parameter " << k;
  }
  // The test can tell: the left perturbation's covariance is another one.
  const Matrix6d A = geometry::adjoint(T_a_b);
  const Matrix6d left = A * stated * A.transpose();
  EXPECT_GT((left.diagonal().cwiseQuotient(stated.diagonal()).array().log().abs()).maxCoeff(), 1.0);
}

}  // namespace
}  // namespace oikos::mapping
