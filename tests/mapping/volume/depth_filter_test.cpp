// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/depth_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "core/base/error.h"

namespace oikos::mapping {
namespace {

TEST(DepthFilter, KeepsSlopesDropsEdgesAndWhatIsOutOfRange) {
  cv::Mat depth(20, 60, CV_32FC1, cv::Scalar(1.0));
  depth.colRange(30, 60).setTo(1.5);                  // an edge between columns 29 and 30
  depth.at<float>(10, 10) = 0.1F;                     // too near
  depth.rowRange(0, 20).colRange(50, 60).setTo(9.0);  // too far
  const cv::Mat filtered = filterDepth(depth, DepthFilterConfig{});
  EXPECT_EQ(filtered.at<float>(10, 20), 1.0F);
  EXPECT_EQ(filtered.at<float>(10, 40), 1.5F);
  for (const int column : {28, 29, 30, 31}) {
    EXPECT_TRUE(std::isnan(filtered.at<float>(10, column))) << column;
  }
  EXPECT_EQ(filtered.at<float>(10, 27), 1.0F);
  EXPECT_TRUE(std::isnan(filtered.at<float>(10, 10)));
  EXPECT_TRUE(std::isnan(filtered.at<float>(10, 55)));
}

TEST(DepthFilter, AHoleIsNoEdge) {
  cv::Mat depth(20, 20, CV_32FC1, cv::Scalar(1.0));
  depth.at<float>(10, 10) = std::numeric_limits<float>::quiet_NaN();
  const cv::Mat filtered = filterDepth(depth, DepthFilterConfig{});
  EXPECT_TRUE(std::isnan(filtered.at<float>(10, 10)));
  EXPECT_EQ(filtered.at<float>(10, 12), 1.0F);
  EXPECT_EQ(filtered.at<float>(8, 10), 1.0F);
}

TEST(DepthFilter, RefusesOtherImages) {
  EXPECT_THROW((void)filterDepth(cv::Mat(4, 4, CV_16UC1, cv::Scalar(1)), DepthFilterConfig{}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::mapping
