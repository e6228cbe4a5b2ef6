// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/corner_detector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <set>
#include <utility>

#include "core/camera/depth_noise.h"
#include "tests/mapping/odometry/wave_texture.h"

namespace oikos::mapping {
namespace {

const cv::Size kSize(640, 480);
const CornerDetectorConfig kConfig;

camera::RgbdFrame frameWith(const cv::Mat& gray, const std::function<double(int u, int v)>& depth_m) {
  camera::RgbdFrame frame;
  frame.gray = gray;
  frame.depth_m.create(gray.size(), CV_32FC1);
  for (int v = 0; v < gray.rows; ++v) {
    for (int u = 0; u < gray.cols; ++u) {
      frame.depth_m.at<float>(v, u) = static_cast<float>(depth_m(u, v));
    }
  }
  return frame;
}

cv::Mat texture() {
  return WaveTexture(17).image(kSize);
}

std::pair<int, int> cellOf(const Eigen::Vector2d& px, int cell_px) {
  return {static_cast<int>(px.x()) / cell_px, static_cast<int>(px.y()) / cell_px};
}

TEST(CornerDetector, SpreadsOneToACell) {
  const auto landmarks = detectCorners(frameWith(texture(), [](int, int) { return 2.0; }), {}, kConfig);
  std::set<std::pair<int, int>> cells;
  for (const Landmark& landmark : landmarks) {
    EXPECT_TRUE(cells.insert(cellOf(landmark.pixel, kConfig.cell_px)).second) << landmark.pixel.transpose();
    EXPECT_EQ(landmark.host, -1);
  }
  const std::size_t all = 25 * 19;
  EXPECT_GT(landmarks.size(), all * 8 / 10);  // textured all over: few cells stay empty
  EXPECT_LE(landmarks.size(), all);
}

TEST(CornerDetector, CellsScaleWithTheImage) {
  const cv::Mat gray = WaveTexture(17).image({320, 240});
  const auto landmarks = detectCorners(frameWith(gray, [](int, int) { return 2.0; }), {}, kConfig);
  std::set<std::pair<int, int>> cells;
  for (const Landmark& landmark : landmarks) {
    EXPECT_TRUE(cells.insert(cellOf(landmark.pixel, kConfig.cell_px / 2)).second);
  }
  EXPECT_GT(landmarks.size(), 150U);
}

TEST(CornerDetector, OccupiedCellsStayEmpty) {
  const camera::RgbdFrame frame = frameWith(texture(), [](int, int) { return 2.0; });
  std::vector<Eigen::Vector2d> occupied;
  for (double u = 5.0; u < 320.0; u += 10.0) {
    for (double v = 5.0; v < 480.0; v += 10.0) {
      occupied.emplace_back(u, v);
    }
  }
  const auto all = detectCorners(frame, {}, kConfig);
  const auto rest = detectCorners(frame, occupied, kConfig);
  EXPECT_GT(rest.size(), all.size() / 3);
  for (const Landmark& landmark : rest) {
    EXPECT_GE(landmark.pixel.x(), 312.0);  // 12 cells of 26 pixels
  }
  occupied = {{-5.0, 1e6}};  // out of the image: counts for the nearest cell, breaks nothing
  EXPECT_GE(detectCorners(frame, occupied, kConfig).size(), all.size() - 1);
}

TEST(CornerDetector, WithoutDepthThereIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(detectCorners(frameWith(texture(), [&](int, int) { return nan; }), {}, kConfig).empty());
  EXPECT_TRUE(detectCorners(frameWith(texture(), [](int, int) { return 0.0; }), {}, kConfig).empty());
  // A quarter of the readings is too few for a plane.
  EXPECT_TRUE(detectCorners(frameWith(texture(), [&](int u, int v) { return u % 2 == 0 && v % 2 == 0 ? 2.0 : nan; }), {}, kConfig).empty());
}

TEST(CornerDetector, HolesInTheDepthAreBridged) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto landmarks = detectCorners(frameWith(texture(), [&](int u, int) { return u % 4 == 0 ? nan : 2.0; }), {}, kConfig);
  EXPECT_GT(landmarks.size(), 300U);
  for (const Landmark& landmark : landmarks) {
    EXPECT_NEAR(landmark.inverse_depth, 0.5, 1e-6);
  }
}

TEST(CornerDetector, FarReadingsMakeNone) {
  EXPECT_TRUE(detectCorners(frameWith(texture(), [](int, int) { return 8.5; }), {}, kConfig).empty());
  EXPECT_FALSE(detectCorners(frameWith(texture(), [](int, int) { return 7.5; }), {}, kConfig).empty());
}

TEST(CornerDetector, PlainImagesAndEdgesHaveNone) {
  const auto flat = [](int, int) { return 2.0; };
  EXPECT_TRUE(detectCorners(frameWith(cv::Mat(kSize, CV_8UC1, cv::Scalar(77)), flat), {}, kConfig).empty());
  cv::Mat edge(kSize, CV_8UC1, cv::Scalar(40));
  edge(cv::Rect(320, 0, 320, 480)).setTo(200);
  EXPECT_TRUE(detectCorners(frameWith(edge, flat), {}, kConfig).empty());
}

/// Contrast of the texture, as a share.
cv::Mat faded(double share) {
  cv::Mat faint;
  texture().convertTo(faint, CV_8UC1, share, 127.0 * (1.0 - share));
  return faint;
}

TEST(CornerDetector, AFaintWallStillHasEnough) {
  const auto flat = [](int, int) { return 0.8; };
  CornerDetectorConfig strong_only = kConfig;
  strong_only.enough = 0;
  const double share = 0.2;
  ASSERT_LT(detectCorners(frameWith(faded(share), flat), {}, strong_only).size(), 60U);
  EXPECT_EQ(detectCorners(frameWith(faded(share), flat), {}, kConfig).size(), static_cast<std::size_t>(kConfig.enough));
}

TEST(CornerDetector, FaintCornersOnlyFillUpWhatStrongOnesLeave) {
  const auto flat = [](int, int) { return 0.8; };
  cv::Mat half = faded(0.2);
  texture()(cv::Rect(0, 0, 200, 480)).copyTo(half(cv::Rect(0, 0, 200, 480)));
  CornerDetectorConfig strong_only = kConfig;
  strong_only.enough = 0;
  const auto strong = detectCorners(frameWith(half, flat), {}, strong_only);
  const auto all = detectCorners(frameWith(half, flat), {}, kConfig);
  ASSERT_GT(strong.size(), 80U);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kConfig.enough));
  for (std::size_t i = 0; i < strong.size(); ++i) {
    EXPECT_EQ(all[i].pixel, strong[i].pixel);
  }
  const auto as_many_seen = detectCorners(frameWith(half, flat), std::vector<Eigen::Vector2d>(200, {20.0, 20.0}), kConfig);
  EXPECT_LE(as_many_seen.size(), strong.size());
}

TEST(CornerDetector, TheNoiseOfADimPictureIsNoTexture) {
  cv::RNG random(11);
  cv::Mat gray(kSize, CV_8UC1);
  for (int v = 0; v < gray.rows; ++v) {
    for (int u = 0; u < gray.cols; ++u) {
      gray.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(30.0 + random.gaussian(1.5));
    }
  }
  EXPECT_TRUE(detectCorners(frameWith(gray, [](int, int) { return 2.0; }), {}, kConfig).empty());
}

TEST(CornerDetector, KeepsOffTheBorder) {
  for (const Landmark& landmark : detectCorners(frameWith(texture(), [](int, int) { return 2.0; }), {}, kConfig)) {
    EXPECT_GE(landmark.pixel.minCoeff(), 9.0);
    EXPECT_LT(landmark.pixel.x(), kSize.width - 9);
    EXPECT_LT(landmark.pixel.y(), kSize.height - 9);
  }
}

// A plane in space is linear in inverse depth: its value and gradient are known exactly.
TEST(CornerDetector, ObliquePlaneHasItsInverseDepthGradient) {
  const Eigen::Vector2d gradient(0.0004, -0.0003);
  const auto inverse_depth = [&](double u, double v) { return 0.5 + gradient.x() * (u - 320.0) + gradient.y() * (v - 240.0); };
  const auto landmarks = detectCorners(frameWith(texture(), [&](int u, int v) { return 1.0 / inverse_depth(u, v); }), {}, kConfig);
  ASSERT_GT(landmarks.size(), 300U);
  for (const Landmark& landmark : landmarks) {
    const double expected = inverse_depth(landmark.pixel.x(), landmark.pixel.y());
    EXPECT_NEAR(landmark.inverse_depth, expected, 1e-6);  // depth is stored as float
    EXPECT_EQ(landmark.measured_inverse_depth, landmark.inverse_depth);
    EXPECT_LT((landmark.inverse_depth_gradient - gradient).norm(), 1e-7);
    EXPECT_NEAR(landmark.sigma, 0.5 * camera::inverseDepthSigma(1.0 / expected), 1e-9);
  }
}

TEST(CornerDetector, NoisyPlaneStaysWithinItsSigma) {
  cv::RNG random(4);
  const auto landmarks =
      detectCorners(frameWith(texture(), [&](int, int) { return 2.0 + random.gaussian(camera::depthSigma_m(2.0)); }), {}, kConfig);
  ASSERT_GT(landmarks.size(), 300U);
  for (const Landmark& landmark : landmarks) {
    EXPECT_LT(std::abs(landmark.inverse_depth - 0.5), 4.0 * landmark.sigma);
    EXPECT_LT(landmark.inverse_depth_gradient.norm(), 5.0 * camera::inverseDepthSigma(2.0) / 11.0);
  }
}

TEST(CornerDetector, RoughSurfacesHaveNone) {
  cv::RNG random(4);
  EXPECT_LT(detectCorners(frameWith(texture(), [&](int, int) { return random.uniform(1.0, 3.0); }), {}, kConfig).size(), 5U);
}

// At the edge of a table the texture belongs to the table, not to the floor behind it.
TEST(CornerDetector, AtAnEdgeTheNearerSideIsTaken) {
  constexpr int kEdge_px = 320;
  const auto landmarks = detectCorners(frameWith(texture(), [](int u, int) { return u < kEdge_px ? 1.0 : 2.0; }), {}, kConfig);
  int at_edge = 0;
  for (const Landmark& landmark : landmarks) {
    const double beyond_px = landmark.pixel.x() - kEdge_px;
    if (std::abs(beyond_px + 0.5) < 1.6) {
      ++at_edge;
      EXPECT_NEAR(landmark.inverse_depth, 1.0, 1e-6);
      EXPECT_EQ(landmark.inverse_depth_gradient, Eigen::Vector2d::Zero());
      EXPECT_NEAR(landmark.sigma, camera::inverseDepthSigma(1.0), 1e-9);  // twice that of a surface
    } else if (beyond_px < -6.0 || beyond_px > 6.0) {
      EXPECT_NEAR(landmark.inverse_depth, beyond_px < 0.0 ? 1.0 : 0.5, 1e-6);
    } else {
      EXPECT_TRUE(std::abs(landmark.inverse_depth - 1.0) < 1e-6 || std::abs(landmark.inverse_depth - 0.5) < 1e-6) << "between the surfaces";
    }
  }
  EXPECT_GE(at_edge, 1);
}

TEST(CornerDetector, IsDeterministic) {
  const camera::RgbdFrame frame = frameWith(texture(), [](int, int) { return 2.0; });
  const auto a = detectCorners(frame, {}, kConfig);
  const auto b = detectCorners(frame, {}, kConfig);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].pixel, b[i].pixel);
  }
}

}  // namespace
}  // namespace oikos::mapping
