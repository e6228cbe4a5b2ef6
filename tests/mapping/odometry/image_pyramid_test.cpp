// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/image_pyramid.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/error.h"

namespace oikos::mapping {
namespace {

/// A soft bright spot about `centre`.
cv::Mat spot(const cv::Size& size, const Eigen::Vector2d& centre) {
  constexpr double kWidth_px = 10.0;
  cv::Mat image(size, CV_8UC1);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const double distance_sq = (Eigen::Vector2d(u, v) - centre).squaredNorm();
      image.at<unsigned char>(v, u) = cv::saturate_cast<unsigned char>(250.0 * std::exp(-0.5 * distance_sq / (kWidth_px * kWidth_px)));
    }
  }
  return image;
}

Eigen::Vector2d centroid(const cv::Mat& image) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double mass = 0.0;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      sum += image.at<unsigned char>(v, u) * Eigen::Vector2d(u, v);
      mass += image.at<unsigned char>(v, u);
    }
  }
  return sum / mass;
}

TEST(ImagePyramid, EachLevelIsHalfTheSize) {
  const ImagePyramid pyramid(cv::Mat::zeros(480, 640, CV_8UC1), 4);
  ASSERT_EQ(pyramid.levels(), 4);
  EXPECT_EQ(pyramid.level(0).size(), cv::Size(640, 480));
  EXPECT_EQ(pyramid.level(1).size(), cv::Size(320, 240));
  EXPECT_EQ(pyramid.level(3).size(), cv::Size(80, 60));
  EXPECT_EQ(pyramid.level(3).type(), CV_8UC1);
}

TEST(ImagePyramid, LevelsEndAboveTwentyFourPixels) {
  EXPECT_EQ(ImagePyramid(cv::Mat::zeros(480, 640, CV_8UC1), 10).levels(), 5);
  EXPECT_EQ(ImagePyramid(cv::Mat::zeros(48, 64, CV_8UC1), 10).levels(), 2);
  EXPECT_EQ(ImagePyramid(cv::Mat::zeros(47, 64, CV_8UC1), 10).levels(), 1);
  EXPECT_EQ(ImagePyramid(cv::Mat::zeros(1, 1, CV_8UC1), 10).levels(), 1);
}

TEST(ImagePyramid, StartsEmpty) {
  EXPECT_TRUE(ImagePyramid().empty());
  EXPECT_EQ(ImagePyramid().levels(), 0);
  EXPECT_FALSE(ImagePyramid(cv::Mat::zeros(48, 64, CV_8UC1), 1).empty());
}

TEST(ImagePyramid, PixelCentresAreWhereTheClassSays) {
  const Eigen::Vector2d centre(401.3, 222.8);
  const ImagePyramid pyramid(spot({640, 480}, centre), 4);
  for (int l = 0; l < pyramid.levels(); ++l) {
    const Eigen::Vector2d expected = (centre + Eigen::Vector2d(0.5, 0.5)) / (1 << l) - Eigen::Vector2d(0.5, 0.5);
    EXPECT_LT((centroid(pyramid.level(l)) - expected).norm(), 0.02) << "level " << l;
  }
}

// 540 rows halve to 135: the odd row is left out, the rest must not be stretched over it.
TEST(ImagePyramid, PixelCentresHoldForOddSizes) {
  const Eigen::Vector2d centre(301.3, 222.8);
  const ImagePyramid pyramid(spot({343, 271}, centre), 3);
  ASSERT_EQ(pyramid.level(2).size(), cv::Size(85, 67));
  for (int l = 0; l < pyramid.levels(); ++l) {
    const Eigen::Vector2d expected = (centre + Eigen::Vector2d(0.5, 0.5)) / (1 << l) - Eigen::Vector2d(0.5, 0.5);
    EXPECT_LT((centroid(pyramid.level(l)) - expected).norm(), 0.02) << "level " << l;
  }
}

TEST(ImagePyramid, APixelIsTheMeanOfFour) {
  cv::Mat image = cv::Mat::zeros(48, 64, CV_8UC1);
  image.at<unsigned char>(10, 20) = 40;
  image.at<unsigned char>(11, 21) = 80;
  const ImagePyramid pyramid(image, 2);
  EXPECT_EQ(pyramid.level(1).at<unsigned char>(5, 10), 30);
  EXPECT_EQ(cv::countNonZero(pyramid.level(1)), 1);
}

TEST(ImagePyramid, RefusesWhatIsNoGreyImage) {
  EXPECT_THROW(ImagePyramid(cv::Mat(), 3), base::ContractViolation);
  EXPECT_THROW(ImagePyramid(cv::Mat::zeros(48, 64, CV_8UC3), 3), base::ContractViolation);
  EXPECT_THROW(ImagePyramid(cv::Mat::zeros(48, 64, CV_32FC1), 3), base::ContractViolation);
  EXPECT_THROW(ImagePyramid(cv::Mat::zeros(48, 64, CV_8UC1), 0), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::mapping
