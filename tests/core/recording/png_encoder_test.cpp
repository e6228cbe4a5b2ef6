// SPDX-License-Identifier: Apache-2.0
#include "core/recording/png_encoder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/imgcodecs.hpp>

#include "core/base/error.h"
#include "core/recording/depth_png.h"
#include "core/recording/image_codec.h"

namespace oikos::recording {
namespace {

std::uint32_t hashOf(int u, int v) {
  std::uint32_t hash = static_cast<std::uint32_t>(u) * 0x9E3779B9U ^ static_cast<std::uint32_t>(v) * 0x85EBCA6BU;
  hash ^= hash >> 15U;
  hash *= 0x2C1B3C6DU;
  return hash ^ hash >> 13U;
}

/// A slope with noise in its upper half, so that every filter is chosen somewhere.
cv::Mat color(int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const std::uint32_t noise = v < height / 2 ? hashOf(u, v) : 0;
      image.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(3 * u + 2 * v), static_cast<std::uint8_t>(5 * v + (noise & 7U)),
                                   static_cast<std::uint8_t>(u * v + (noise >> 24U))};
    }
  }
  return image;
}

cv::Mat depth(int width, int height) {
  cv::Mat image(height, width, CV_16UC1);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      image.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(u * 700 + v * 300 + (hashOf(u, v) % 5));
    }
  }
  return image;
}

double difference(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() ? cv::norm(a, b, cv::NORM_INF) : -1.0;
}

TEST(PngEncoder, EveryLevelDecodesToTheSamePixels) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {7, 1}, {61, 47}, {128, 3}}) {
    for (int level = 0; level <= 9; ++level) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", level " << level);
      const auto bgr_png = encodePng(color(width, height), level);
      EXPECT_EQ(difference(cv::imdecode(bgr_png, cv::IMREAD_UNCHANGED), color(width, height)), 0.0);
      EXPECT_EQ(difference(decodeColorImage({reinterpret_cast<const char*>(bgr_png.data()), bgr_png.size()}, "c"), color(width, height)),
                0.0);
      const auto depth_png = encodePng(depth(width, height), level);
      EXPECT_EQ(difference(cv::imdecode(depth_png, cv::IMREAD_UNCHANGED), depth(width, height)), 0.0);
      EXPECT_EQ(difference(decodeDepthPng({reinterpret_cast<const char*>(depth_png.data()), depth_png.size()}, "d"), depth(width, height)),
                0.0);
    }
  }
}

TEST(PngEncoder, KeepsTransparency) {
  cv::Mat image(23, 31, CV_8UC4);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const std::uint32_t hash = hashOf(u, v);
      image.at<cv::Vec4b>(v, u) = {static_cast<std::uint8_t>(hash), static_cast<std::uint8_t>(7 * u), static_cast<std::uint8_t>(5 * v),
                                   static_cast<std::uint8_t>(hash >> 24U)};
    }
  }
  for (const int level : {0, 1, 9}) {
    EXPECT_EQ(difference(cv::imdecode(encodePng(image, level), cv::IMREAD_UNCHANGED), image), 0.0) << level;
  }
}

TEST(PngEncoder, APartOfAPictureIsWrittenAsThatPart) {
  const cv::Mat part = color(61, 47)(cv::Rect(5, 6, 20, 10));
  EXPECT_EQ(difference(cv::imdecode(encodePng(part, 6), cv::IMREAD_UNCHANGED), part), 0.0);
}

TEST(PngEncoder, HigherLevelsAreSmaller) {
  const cv::Mat image = color(320, 240);
  EXPECT_GT(encodePng(image, 0).size(), 3U * 320U * 240U);
  EXPECT_LT(encodePng(image, 1).size(), encodePng(image, 0).size() / 2);
  EXPECT_LT(encodePng(image, 9).size(), encodePng(image, 1).size());
}

TEST(PngEncoder, OtherPixelsAndLevelsAreABug) {
  EXPECT_THROW(static_cast<void>(encodePng(cv::Mat(2, 2, CV_8UC2), 6)), base::ContractViolation);
  EXPECT_THROW(static_cast<void>(encodePng(cv::Mat(), 6)), base::ContractViolation);
  EXPECT_THROW(static_cast<void>(encodePng(color(2, 2), 10)), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::recording
