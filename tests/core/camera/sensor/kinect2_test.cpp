// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/kinect2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <tuple>

#include "tests/core/camera/sensor/flat_scene.h"
#include "tests/core/camera/sensor/running_moments.h"

namespace oikos::camera {
namespace {

using test::FlatScene;
using test::RunningMoments;

constexpr double kRadian = std::numbers::pi / 180.0;
constexpr PinholeCamera kNarrow = {200, 150, 4000.0, 4000.0, 99.5, 74.5};
constexpr PinholeCamera kCamera = {200, 150, 365.0, 365.0, 99.5, 74.5};

RunningMoments errors(const FlatScene& scene, int frames) {
  RunningMoments moments;
  for (int frame = 0; frame < frames; ++frame) {
    const cv::Mat depth_m = senseKinect2(scene.view(), scene.camera(), {}, {4, frame, 1});
    for (int v = 0; v < depth_m.rows; ++v) {
      for (int u = 0; u < depth_m.cols; ++u) {
        const float error_m = depth_m.at<float>(v, u) - scene.view().depth_m.at<float>(v, u);
        if (!std::isnan(error_m)) {
          moments.add(static_cast<double>(error_m));
        }
      }
    }
  }
  return moments;
}

TEST(Kinect2Noise, TheModelIsThePublishedOne) {
  EXPECT_NEAR(kinect2AxialSigma_m(2.0, 0.0), 0.0015 - 0.001 + 0.0012, 1e-8);
  EXPECT_NEAR(kinect2AxialSigma_m(1.0, 72.0 * kRadian), 0.0013 + 0.0001 * 16.0, 1e-6);
}

class Kinect2Axial : public testing::TestWithParam<std::tuple<double, double, double>> {};

TEST_P(Kinect2Axial, ErrorsHaveThePublishedDeviationAndNoBias) {
  const auto [z_m, theta_deg, reflectivity] = GetParam();
  FlatScene scene(kNarrow);
  scene.addPlane(z_m, theta_deg * kRadian, reflectivity);
  const RunningMoments moments = errors(scene, 2);
  ASSERT_GT(moments.count, 50000.0);
  const double expected_m = kinect2AxialSigma_m(z_m, theta_deg * kRadian) * std::sqrt(0.5 / reflectivity);
  // the plane is not quite the same distance and angle all over the image: 2 %
  EXPECT_NEAR(moments.deviation() / expected_m, 1.0, 5.0 / std::sqrt(2.0 * moments.count) + 0.02);
  EXPECT_NEAR(moments.mean() / expected_m, 0.0, 5.0 / std::sqrt(moments.count));
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Kinect2Axial,
                         testing::Combine(testing::Values(1.0, 2.0, 3.0), testing::Values(0.0, 45.0, 70.0), testing::Values(0.5, 0.2)));

TEST(Kinect2Edges, FlyingPixelsLieBetweenTheSurfacesAndOnlyAtEdges) {
  FlatScene scene(kCamera);
  scene.addPlane(2.0, 0.0).addBoard({60, 40, 80, 60}, 1.0);
  int flying = 0;
  int dropped = 0;
  constexpr int kFrames = 10;
  for (int frame = 0; frame < kFrames; ++frame) {
    const cv::Mat depth_m = senseKinect2(scene.view(), kCamera, {}, {6, frame, 1});
    for (int v = 0; v < depth_m.rows; ++v) {
      for (int u = 0; u < depth_m.cols; ++u) {
        const float z_m = depth_m.at<float>(v, u);
        const bool inside = u > 60 && u < 139 && v > 40 && v < 99;
        const bool outside = u < 59 || u > 140 || v < 39 || v > 100;
        if (inside || outside) {
          ASSERT_NEAR(z_m, inside ? 1.0F : 2.0F, 0.01F) << u << "," << v;
        } else if (std::isnan(z_m)) {
          ++dropped;
        } else {
          ASSERT_TRUE(z_m > 0.99F && z_m < 2.01F);
          flying += z_m > 1.02F && z_m < 1.98F ? 1 : 0;
        }
      }
    }
  }
  // two rings of pixels, inside (2·(80 + 60) - 4) and outside (2·(80 + 60)); half is taken away
  const double ring = kFrames * (4.0 * (80 + 60) - 4.0);
  EXPECT_NEAR(dropped, 0.5 * ring, 5.0 * std::sqrt(0.25 * ring));
  EXPECT_EQ(flying, ring - dropped);
}

TEST(Kinect2Edges, APlaneHasNoFlyingPixels) {
  FlatScene scene(kCamera);
  scene.addPlane(1.5, 60.0 * kRadian);
  const cv::Mat depth_m = senseKinect2(scene.view(), kCamera, {}, {6, 0, 1});
  const cv::Mat in_range = (scene.view().depth_m > 0.6F) & (scene.view().depth_m < 3.0F) & (depth_m != depth_m);
  EXPECT_EQ(cv::countNonZero(in_range), 0);
}

double shareOfReadings(const FlatScene& scene) {
  const cv::Mat depth_m = senseKinect2(scene.view(), scene.camera(), {}, {8, 0, 1});
  return cv::countNonZero(depth_m == depth_m) / static_cast<double>(depth_m.total());
}

TEST(Kinect2Dropout, FollowsLightAndAngle) {
  const Kinect2Config config;
  for (const double relative_signal : {0.6, 1.0, 1.3, 2.5}) {
    FlatScene scene(kNarrow);
    scene.addPlane(2.0, 0.0, relative_signal * config.min_signal * 4.0);
    const double expected = 0.5 * std::erfc(-(relative_signal - 1.0) / config.dropout_softness / std::numbers::sqrt2);
    EXPECT_NEAR(shareOfReadings(scene), expected, 5.0 * std::sqrt(0.25 / 30000.0) + 0.002);
  }
  double before = 1.1;
  for (const double theta_deg : {80.0, 83.0, 85.0, 87.0}) {
    FlatScene scene(kNarrow);
    scene.addPlane(2.0, theta_deg * kRadian);
    EXPECT_LT(shareOfReadings(scene), before) << theta_deg;
    before = shareOfReadings(scene);
  }
}

TEST(Kinect2Range, OutsideThereIsNoReading) {
  for (const auto& [z_m, expected] : {std::pair(0.45, 0.0), {0.55, 1.0}, {4.4, 1.0}, {4.6, 0.0}}) {
    FlatScene scene(kNarrow);
    scene.addPlane(z_m, 0.0, 1.0);
    EXPECT_NEAR(shareOfReadings(scene), expected, 0.001) << z_m;
  }
}

}  // namespace
}  // namespace oikos::camera
