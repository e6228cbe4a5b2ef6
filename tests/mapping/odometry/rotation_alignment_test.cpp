// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/rotation_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/geometry/se3.h"
#include "tests/support/textured_world.h"

namespace oikos::mapping {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTolerance_rad = 0.1 * kDegree;  ///< a seventh of a pixel of the small image

double angleBetween(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) {
  return geometry::logSo3(A.transpose() * B).norm();
}

/// Pictures taken from one place in the textured room.
class RotationAlignmentTest : public ::testing::Test {
 protected:
  [[nodiscard]] cv::Mat picture(const Eigen::Matrix3d& R_start_camera) const {
    Eigen::Isometry3d T_map_camera = T_map_start_;
    T_map_camera.linear() = T_map_start_.linear() * R_start_camera;
    return world_.render(camera_, T_map_camera).gray;
  }
  [[nodiscard]] RotationAlignment align(const cv::Mat& current, const Eigen::Matrix3d& guess) const {
    return alignRotation(previous_, ImagePyramid(current, 5), camera_, guess);
  }

  const test::TexturedWorld world_ = test::TexturedWorld::furnished();
  const camera::PinholeCamera camera_ = test::texturedCamera();
  const Eigen::Isometry3d T_map_start_ = test::lookAt({-1.2, 0.1, 1.2}, {1.0, 0.0, 0.8});
  const ImagePyramid previous_{picture(Eigen::Matrix3d::Identity()), 5};
};

TEST_F(RotationAlignmentTest, StaysAtTheAnswer) {
  const RotationAlignment found = align(picture(Eigen::Matrix3d::Identity()), Eigen::Matrix3d::Identity());
  EXPECT_TRUE(found.converged);
  EXPECT_LT(angleBetween(found.R_previous_current, Eigen::Matrix3d::Identity()), 1e-3 * kDegree);
  EXPECT_LT(found.rms, 1e-3);
}

TEST_F(RotationAlignmentTest, FindsTurnsFromNoGuess) {
  for (const double angle_deg : {0.3, 1.0, 2.0, 3.0}) {
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-0.6, 0.7, 0.4)}) {
      const Eigen::Matrix3d R = geometry::expSo3(angle_deg * kDegree * axis.normalized());
      const RotationAlignment found = align(picture(R), Eigen::Matrix3d::Identity());
      EXPECT_TRUE(found.converged);
      EXPECT_LT(angleBetween(found.R_previous_current, R), kTolerance_rad) << angle_deg << " deg about " << axis.transpose();
      // The inverse question has the inverse answer.
      const RotationAlignment back = alignRotation(ImagePyramid(picture(R), 5), previous_, camera_, Eigen::Matrix3d::Identity());
      EXPECT_TRUE(back.converged);
      EXPECT_LT(angleBetween(back.R_previous_current, R.transpose()), kTolerance_rad) << angle_deg << " deg about " << axis.transpose();
    }
  }
}

TEST_F(RotationAlignmentTest, FindsLargeTurnsFromARoughGuess) {
  const Eigen::Matrix3d R = geometry::expSo3(20.0 * kDegree * Eigen::Vector3d(0.1, 1.0, 0.1).normalized());
  const cv::Mat current = picture(R);
  for (int k = 0; k < 8; ++k) {
    const double way = 2.0 * std::numbers::pi * k / 8;
    const Eigen::Matrix3d guess = R * geometry::expSo3(2.0 * kDegree * Eigen::Vector3d(std::cos(way), std::sin(way), 0.0));
    const RotationAlignment found = align(current, guess);
    EXPECT_TRUE(found.converged);
    EXPECT_LT(angleBetween(found.R_previous_current, R), kTolerance_rad) << "start " << k;
  }
}

TEST_F(RotationAlignmentTest, BrightnessDoesNotMatter) {
  const Eigen::Matrix3d R = geometry::expSo3(Eigen::Vector3d(0.02, -0.03, 0.015));
  for (const auto& [gain, bias] : {std::pair(0.7, 20.0), std::pair(0.5, 0.0), std::pair(1.0, 15.0)}) {
    cv::Mat current;
    picture(R).convertTo(current, CV_8U, gain, bias);
    const RotationAlignment found = align(current, Eigen::Matrix3d::Identity());
    EXPECT_TRUE(found.converged) << "gain " << gain;
    EXPECT_LT(angleBetween(found.R_previous_current, R), kTolerance_rad) << "gain " << gain;
  }
}

TEST_F(RotationAlignmentTest, AnswerIsARotation) {
  const RotationAlignment found = align(picture(geometry::expSo3(Eigen::Vector3d(0.02, -0.03, 0.015))), Eigen::Matrix3d::Identity());
  EXPECT_LT((found.R_previous_current * found.R_previous_current.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST_F(RotationAlignmentTest, NoOverlapIsNotConvergedAndKeepsTheGuess) {
  const Eigen::Matrix3d guess = geometry::expSo3(Eigen::Vector3d(0.0, 120.0 * kDegree, 0.0));
  const RotationAlignment found = align(picture(guess), guess);
  EXPECT_FALSE(found.converged);
  EXPECT_TRUE(found.R_previous_current.isApprox(guess, 1e-15));
}

TEST_F(RotationAlignmentTest, AnotherPlaceShowsInTheResidual) {
  const Eigen::Matrix3d R = geometry::expSo3(2.0 * kDegree * Eigen::Vector3d::UnitY());
  const RotationAlignment same = align(picture(R), Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d away = geometry::expSo3(Eigen::Vector3d(0.0, 150.0 * kDegree, 0.0));
  const RotationAlignment other = align(picture(away), Eigen::Matrix3d::Identity());
  EXPECT_LT(same.rms, 5.0);
  EXPECT_GT(other.rms, 3.0 * same.rms);
  EXPECT_GT(other.rms, 15.0);
}

TEST_F(RotationAlignmentTest, PlainPicturesAreNotConverged) {
  const ImagePyramid plain(cv::Mat(camera_.height, camera_.width, CV_8UC1, cv::Scalar(90)), 5);
  EXPECT_FALSE(alignRotation(plain, plain, camera_, Eigen::Matrix3d::Identity()).converged);
}

}  // namespace
}  // namespace oikos::mapping
