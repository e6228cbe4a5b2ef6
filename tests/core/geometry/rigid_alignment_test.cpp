// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/rigid_alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "core/base/error.h"

namespace oikos::geometry {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Eigen::Isometry3d motion(double angle_rad, const Eigen::Vector3d& axis, const Eigen::Vector3d& translation) {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  T_a_b.linear() = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  T_a_b.translation() = translation;
  return T_a_b;
}

Points randomPoints(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate_m(-2.0, 2.0);
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(coordinate_m(random), coordinate_m(random), coordinate_m(random));
  }
  return points;
}

Points mapped(const Points& points_b, const Eigen::Isometry3d& T_a_b, double scale = 1.0) {
  Points points_a;
  for (const Eigen::Vector3d& point : points_b) {
    points_a.push_back(scale * (T_a_b.linear() * point) + T_a_b.translation());
  }
  return points_a;
}

double angleBetween(const Eigen::Isometry3d& first, const Eigen::Isometry3d& second) {
  return Eigen::AngleAxisd(first.linear().transpose() * second.linear()).angle();
}

void expectSame(const Eigen::Isometry3d& expected, const Eigen::Isometry3d& actual, double translation_m, double rotation_rad) {
  EXPECT_LE((expected.translation() - actual.translation()).norm(), translation_m);
  EXPECT_LE(angleBetween(expected, actual), rotation_rad);
  EXPECT_NEAR(actual.linear().determinant(), 1.0, 1e-12);
}

TEST(RigidAlignment, RecoversMotionsOfEverySize) {
  for (const double angle_rad : {0.0, 1e-6, 0.7, 2.0, std::numbers::pi}) {
    const Eigen::Isometry3d T_a_b = motion(angle_rad, {1, -2, 0.5}, {3, -1, 0.25});
    const Points points_b = randomPoints(50, 1);
    const RigidAlignment result = alignRigid(mapped(points_b, T_a_b), points_b);
    ASSERT_EQ(result.status, RigidAlignmentStatus::kAligned);
    expectSame(T_a_b, result.T_a_b, 1e-9, 1e-7);
    EXPECT_DOUBLE_EQ(result.scale, 1.0);
    EXPECT_LT(result.rms_m, 1e-9);
    EXPECT_GT(result.conditioning, 0.5);
  }
}

TEST(RigidAlignment, ThreePointsSuffice) {
  const Eigen::Isometry3d T_a_b = motion(1.2, {0, 1, 1}, {0.1, 0.2, 0.3});
  const Points points_b = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const RigidAlignment result = alignRigid(mapped(points_b, T_a_b), points_b);
  ASSERT_EQ(result.status, RigidAlignmentStatus::kAligned);
  expectSame(T_a_b, result.T_a_b, 1e-9, 1e-7);
}

// Four corners of a unit square, b's second diagonal lengthened: the residual is 0.1 m at two of the four corners.
TEST(RigidAlignment, ReportsTheResidualOfAHandComputedCase) {
  const Points points_a = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const Points points_b = {{1.1, 0, 0}, {0, 1, 0}, {-1.1, 0, 0}, {0, -1, 0}};
  const RigidAlignment result = alignRigid(points_a, points_b);
  ASSERT_EQ(result.status, RigidAlignmentStatus::kAligned);
  expectSame(Eigen::Isometry3d::Identity(), result.T_a_b, 1e-12, 1e-9);
  EXPECT_NEAR(result.rms_m, 0.1 / std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(result.conditioning, 1.0 / 1.1, 1e-12);
}

TEST(RigidAlignment, NoisyPairsStayWithinTheNoise) {
  constexpr double kNoise_m = 0.01;
  constexpr int kCount = 2000;
  const Eigen::Isometry3d T_a_b = motion(0.9, {1, 1, -1}, {5, 6, -7});
  const Points points_b = randomPoints(kCount, 2);
  Points points_a = mapped(points_b, T_a_b);
  std::mt19937 random(3);
  std::normal_distribution<double> noise_m(0.0, kNoise_m);
  for (Eigen::Vector3d& point : points_a) {
    point += Eigen::Vector3d(noise_m(random), noise_m(random), noise_m(random));
  }
  const RigidAlignment result = alignRigid(points_a, points_b);
  ASSERT_EQ(result.status, RigidAlignmentStatus::kAligned);
  const double standard_error_m = kNoise_m / std::sqrt(static_cast<double>(kCount));
  expectSame(T_a_b, result.T_a_b, 5 * standard_error_m, 5 * standard_error_m);
  EXPECT_NEAR(result.rms_m, kNoise_m * std::sqrt(3.0), 0.05 * kNoise_m);
}

TEST(RigidAlignment, WeightsSilenceWrongPairs) {
  const Eigen::Isometry3d T_a_b = motion(0.4, {0, 0, 1}, {1, 2, 3});
  const Points points_b = randomPoints(10, 4);
  Points points_a = mapped(points_b, T_a_b);
  points_a[3] += Eigen::Vector3d(10, 0, 0);
  std::vector<double> weights(points_a.size(), 2.5);
  weights[3] = 0.0;
  const RigidAlignment result = alignRigid(points_a, points_b, weights);
  ASSERT_EQ(result.status, RigidAlignmentStatus::kAligned);
  expectSame(T_a_b, result.T_a_b, 1e-9, 1e-7);
  EXPECT_LT(result.rms_m, 1e-9);
}

TEST(RigidAlignment, AWeightOfTwoIsTheSamePairTwice) {
  const Points points_b = randomPoints(6, 5);
  Points points_a = randomPoints(6, 6);
  const RigidAlignment weighted = alignRigid(points_a, points_b, std::vector<double>{2, 1, 1, 1, 1, 1});
  Points twice_a = points_a;
  Points twice_b = points_b;
  twice_a.push_back(points_a[0]);
  twice_b.push_back(points_b[0]);
  const RigidAlignment repeated = alignRigid(twice_a, twice_b);
  expectSame(repeated.T_a_b, weighted.T_a_b, 1e-9, 1e-7);
  EXPECT_NEAR(repeated.rms_m, weighted.rms_m, 1e-12);
}

TEST(RigidAlignment, FreesTheScaleOnRequestOnly) {
  const Eigen::Isometry3d T_a_b = motion(0.4, {0, 1, 1}, {1, 2, 3});
  const Points points_b = randomPoints(20, 7);
  const Points points_a = mapped(points_b, T_a_b, 1.7);
  const RigidAlignment similarity = alignRigid(points_a, points_b, {}, AlignmentScale::kFree);
  ASSERT_EQ(similarity.status, RigidAlignmentStatus::kAligned);
  EXPECT_NEAR(similarity.scale, 1.7, 1e-9);
  expectSame(T_a_b, similarity.T_a_b, 1e-9, 1e-7);
  EXPECT_LT((similarity.apply(points_b[5]) - points_a[5]).norm(), 1e-9);
  EXPECT_DOUBLE_EQ(alignRigid(points_a, points_b).scale, 1.0);
}

TEST(RigidAlignment, NeverAnswersWithAMirrorImage) {
  const Points points_b = randomPoints(30, 8);
  Points points_a = points_b;
  for (Eigen::Vector3d& point : points_a) {
    point.z() = -point.z();
  }
  const RigidAlignment result = alignRigid(points_a, points_b);
  ASSERT_EQ(result.status, RigidAlignmentStatus::kAligned);
  EXPECT_NEAR(result.T_a_b.linear().determinant(), 1.0, 1e-12);
  EXPECT_GT(result.rms_m, 0.1);
}

TEST(RigidAlignment, TooFewPoints) {
  EXPECT_EQ(alignRigid({}, {}).status, RigidAlignmentStatus::kTooFewPoints);
  const Points two = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(alignRigid(two, two).status, RigidAlignmentStatus::kTooFewPoints);
  const Points three = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(alignRigid(three, three, std::vector<double>{1, 1, 0}).status, RigidAlignmentStatus::kTooFewPoints);
}

TEST(RigidAlignment, NonFiniteInput) {
  const Points good = randomPoints(5, 9);
  Points bad = good;
  bad[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(alignRigid(bad, good).status, RigidAlignmentStatus::kNonFinite);
  EXPECT_EQ(alignRigid(good, bad).status, RigidAlignmentStatus::kNonFinite);
  std::vector<double> weights(5, 1.0);
  weights[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(alignRigid(good, good, weights).status, RigidAlignmentStatus::kNonFinite);
}

TEST(RigidAlignment, ALineLeavesTheRotationOpen) {
  Points line;
  for (int i = 0; i < 20; ++i) {
    line.emplace_back(100.0 + 0.1 * i, -50.0 + 0.2 * i, 7.0 - 0.3 * i);
  }
  const Eigen::Isometry3d T_a_b = motion(0.8, {1, 2, 3}, {4, 5, 6});
  const RigidAlignment result = alignRigid(mapped(line, T_a_b), line);
  EXPECT_EQ(result.status, RigidAlignmentStatus::kCollinear);
  EXPECT_LT(result.rms_m, 1e-9);
  EXPECT_LT((result.apply(line[7]) - T_a_b * line[7]).norm(), 1e-9);
}

TEST(RigidAlignment, OnePointRepeatedLeavesTheRotationOpen) {
  const Points same(4, Eigen::Vector3d(1, 2, 3));
  const RigidAlignment result = alignRigid(same, same, {}, AlignmentScale::kFree);
  EXPECT_EQ(result.status, RigidAlignmentStatus::kCollinear);
  EXPECT_EQ(result.conditioning, 0.0);
  EXPECT_EQ(result.scale, 1.0);
  EXPECT_LT(result.rms_m, 1e-12);
}

TEST(RigidAlignment, UnpairedOrNegativelyWeightedInputBreaksTheContract) {
  const Points three = randomPoints(3, 10);
  const Points four = randomPoints(4, 10);
  EXPECT_THROW(static_cast<void>(alignRigid(three, four)), base::ContractViolation);
  EXPECT_THROW(static_cast<void>(alignRigid(three, three, std::vector<double>{1, 1})), base::ContractViolation);
  EXPECT_THROW(static_cast<void>(alignRigid(three, three, std::vector<double>{1, 1, -1})), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::geometry
