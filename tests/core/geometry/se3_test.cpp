// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/se3.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <numbers>
#include <random>

namespace oikos::geometry {
namespace {

constexpr double kExact = 1e-9;

class Se3 : public ::testing::Test {
 protected:
  Eigen::Vector3d direction() { return Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_)).normalized(); }
  Eigen::Vector3d vector(double scale) { return scale * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_)); }
  Vector6d twist(double angle_rad) {
    Vector6d xi;
    xi.head<3>() = vector(1.0);
    xi.tail<3>() = angle_rad * direction();
    return xi;
  }
  Eigen::Isometry3d pose() { return expSe3(twist(1.3)); }

 private:
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

/// The definition: the power series of the 4 x 4 matrix, halved until it is short.
Eigen::Matrix4d exponentialBySeries(const Vector6d& xi) {
  constexpr int kHalvings = 6;
  Eigen::Matrix4d X = Eigen::Matrix4d::Zero();
  X.topLeftCorner<3, 3>() = skew(xi.tail<3>());
  X.topRightCorner<3, 1>() = xi.head<3>();
  X /= 1 << kHalvings;
  Eigen::Matrix4d sum = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d term = Eigen::Matrix4d::Identity();
  for (int k = 1; k < 16; ++k) {
    term = term * X / k;
    sum += term;
  }
  for (int k = 0; k < kHalvings; ++k) {
    sum = (sum * sum).eval();
  }
  return sum;
}

TEST_F(Se3, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a = vector(1.0);
  const Eigen::Vector3d b = vector(1.0);
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST_F(Se3, ExponentialIsThePowerSeries) {
  for (const double angle_rad : {0.0, 1e-12, 1e-9, 1e-6, 0.99e-5, 1.01e-5, 1e-4, 1e-2, 0.5, 2.0, 3.1, 4.0, 6.0}) {
    const Vector6d xi = twist(angle_rad);
    EXPECT_LT((expSe3(xi).matrix() - exponentialBySeries(xi)).norm(), kExact) << "angle " << angle_rad;
    EXPECT_LT((expSo3(xi.tail<3>()) - exponentialBySeries(xi).topLeftCorner<3, 3>()).norm(), kExact) << "angle " << angle_rad;
  }
}

TEST_F(Se3, LogarithmUndoesTheExponential) {
  for (const double angle_rad : {0.0, 1e-15, 1e-12, 1e-9, 1e-8, 1e-6, 1e-5, 1e-3, 0.1, 1.0, 2.0, 3.0, 3.14, 3.14159}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const Vector6d xi = twist(angle_rad);
      const Vector6d back = logSe3(expSe3(xi));
      EXPECT_LT((back.head<3>() - xi.head<3>()).norm(), kExact) << "angle " << angle_rad;
      EXPECT_LT((back.tail<3>() - xi.tail<3>()).norm(), kExact) << "angle " << angle_rad;
    }
  }
}

TEST_F(Se3, TinyAnglesKeepTheirRelativePrecision) {
  for (const double angle_rad : {1e-7, 1e-9, 1e-12}) {
    const Eigen::Vector3d omega_rad = angle_rad * direction();
    EXPECT_LT((logSo3(expSo3(omega_rad)) - omega_rad).norm(), 1e-6 * angle_rad + 1e-16);
  }
}

// At half a turn the axis is known up to its sign only: what must come back is the rotation.
TEST_F(Se3, HalfATurnComesBackAsARotation) {
  for (const double short_of_rad : {1e-3, 1e-6, 1e-9, 1e-12, 0.0, -1e-9, -1e-3}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const Eigen::Matrix3d R = expSo3((std::numbers::pi - short_of_rad) * direction());
      const Eigen::Vector3d omega_rad = logSo3(R);
      EXPECT_LE(omega_rad.norm(), std::numbers::pi + 1e-12);
      EXPECT_NEAR(omega_rad.norm(), std::numbers::pi - std::abs(short_of_rad), 1e-8);
      EXPECT_LT((expSo3(omega_rad) - R).norm(), kExact) << "short of pi by " << short_of_rad;
    }
  }
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d::UnitX().eval(), Eigen::Vector3d::UnitY().eval(), Eigen::Vector3d::UnitZ().eval()}) {
    const Eigen::Matrix3d R = 2.0 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
    EXPECT_LT((expSo3(logSo3(R)) - R).norm(), kExact);
  }
}

TEST_F(Se3, MoreThanHalfATurnIsTheShorterWayRound) {
  const Eigen::Vector3d axis = direction();
  EXPECT_LT((logSo3(expSo3(4.0 * axis)) + (2.0 * std::numbers::pi - 4.0) * axis).norm(), kExact);
}

TEST_F(Se3, AdjointCarriesAPerturbationToTheOtherSide) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Eigen::Isometry3d T = pose();
    const Vector6d xi = twist(0.7);
    EXPECT_LT(((T * expSe3(xi)).matrix() - (expSe3(adjoint(T) * xi) * T).matrix()).norm(), kExact);
  }
}

TEST_F(Se3, AdjointOfAProductIsTheProduct) {
  const Eigen::Isometry3d A = pose();
  const Eigen::Isometry3d B = pose();
  EXPECT_LT((adjoint(A * B) - adjoint(A) * adjoint(B)).norm(), kExact);
  EXPECT_LT((adjoint(A.inverse()) - adjoint(A).inverse()).norm(), kExact);
}

// xi = (translation, rotation), on the right: a step along x is along the moved frame's own x.
TEST_F(Se3, PerturbationsStandOnTheRightTranslationFirst) {
  const Eigen::Isometry3d T_a_b = pose();
  Vector6d along_x = Vector6d::Zero();
  along_x[0] = 0.5;
  const Eigen::Isometry3d moved = T_a_b * expSe3(along_x);
  EXPECT_LT((moved.translation() - (T_a_b.translation() + 0.5 * T_a_b.linear().col(0))).norm(), kExact);
  EXPECT_LT((moved.linear() - T_a_b.linear()).norm(), kExact);
  Vector6d about_z = Vector6d::Zero();
  about_z[5] = 0.5;
  const Eigen::Isometry3d turned = T_a_b * expSe3(about_z);
  EXPECT_LT((turned.translation() - T_a_b.translation()).norm(), kExact);
  EXPECT_LT((turned.linear().col(2) - T_a_b.linear().col(2)).norm(), kExact);
  EXPECT_NEAR(turned.linear().col(0).dot(T_a_b.linear().col(1)), std::sin(0.5), kExact);
}

// d(T exp(xi) p) / d(xi) at 0 = R [I, -[p]x]: what every solver of the house is built on.
TEST_F(Se3, NumericJacobianOfAMovedPoint) {
  constexpr double kStep = 1e-6;
  const Eigen::Isometry3d T_a_b = pose();
  const Eigen::Vector3d p_b = vector(2.0);
  Eigen::Matrix<double, 3, 6> analytic;
  analytic << T_a_b.linear(), -T_a_b.linear() * skew(p_b);
  for (int k = 0; k < 6; ++k) {
    const Vector6d step = kStep * Vector6d::Unit(k);
    const Eigen::Vector3d numeric = (T_a_b * expSe3(step) * p_b - T_a_b * expSe3(-step) * p_b) / (2.0 * kStep);
    EXPECT_LT((numeric - analytic.col(k)).norm(), 1e-8) << "parameter " << k;
  }
}

TEST_F(Se3, InterpolationRunsFromOnePoseToTheOther) {
  const Eigen::Isometry3d T_a_b = pose();
  const Eigen::Isometry3d T_a_c = pose();
  EXPECT_LT((interpolate(T_a_b, T_a_c, 0.0).matrix() - T_a_b.matrix()).norm(), kExact);
  EXPECT_LT((interpolate(T_a_b, T_a_c, 1.0).matrix() - T_a_c.matrix()).norm(), kExact);
  const Eigen::Isometry3d middle = interpolate(T_a_b, T_a_c, 0.5);
  EXPECT_LT((logSe3(T_a_b.inverse() * middle) - logSe3(middle.inverse() * T_a_c)).norm(), kExact);
}

TEST_F(Se3, InterpolationIsOfConstantTwist) {
  const Eigen::Isometry3d T_a_b = pose();
  const Vector6d xi = twist(0.8);
  for (const double fraction : {-0.5, 0.25, 0.9, 1.5}) {
    EXPECT_LT((interpolate(T_a_b, T_a_b * expSe3(xi), fraction).matrix() - (T_a_b * expSe3(fraction * xi)).matrix()).norm(), kExact);
  }
}

TEST_F(Se3, NanStaysNan) {
  Vector6d xi = Vector6d::Zero();
  xi[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(expSe3(xi).matrix().allFinite());
}

}  // namespace
}  // namespace oikos::geometry
