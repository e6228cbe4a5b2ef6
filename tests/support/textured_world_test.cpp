// SPDX-License-Identifier: Apache-2.0
#include "tests/support/textured_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/camera/depth_noise.h"
#include "core/geometry/se3.h"
#include "tests/support/textured_recording.h"

namespace oikos::test {
namespace {

const Eigen::Isometry3d kStart = lookAt({-1.0, 0.0, 1.2}, {1.0, 0.2, 0.7});
const Eigen::Isometry3d kMoved = lookAt({-0.8, 0.2, 1.1}, {1.0, 0.0, 0.7});

SyntheticRecording twoFrames(const SyntheticSensor& sensor) {
  return {TexturedWorld::furnished(), texturedCamera(), {kStart, kMoved}, sensor};
}

bool sameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && std::equal(a.datastart, a.dataend, b.datastart);
}

TEST(TexturedWorld, TheSamePointHasTheSameGreyFromEverywhere) {
  const TexturedWorld world = TexturedWorld::furnished();
  const camera::PinholeCamera camera = texturedCamera();
  const camera::RgbdFrame frame = world.render(camera, kStart);
  double least = 255.0;
  double most = 0.0;
  for (int v = 0; v < camera.height; v += 7) {
    for (int u = 0; u < camera.width; u += 7) {
      const double depth_m = static_cast<double>(frame.depth_m.at<float>(v, u));
      const Eigen::Vector3d point_map = kStart * (depth_m * camera.ray(u, v));
      EXPECT_LT(world.room().distanceToSurface(point_map), 1e-5);
      EXPECT_NEAR(world.grayAt(point_map), frame.gray.at<unsigned char>(v, u), 0.6);
      least = std::min(least, world.grayAt(point_map));
      most = std::max(most, world.grayAt(point_map));
    }
  }
  EXPECT_LT(least, 60.0);
  EXPECT_GT(most, 190.0);
}

TEST(TexturedWorld, TextureIsSmooth) {
  const TexturedWorld world = TexturedWorld::furnished();
  double steepest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d point_map(2.0, -1.0 + 0.001 * i, 1.0);
    const double change = std::abs(world.grayAt(point_map + Eigen::Vector3d(0.0, 0.001, 0.0)) - world.grayAt(point_map));
    steepest = std::max(steepest, change);
  }
  EXPECT_LT(steepest, 12.0);  // grey values a millimetre
  EXPECT_GT(steepest, 1.0);
}

TEST(TexturedWorld, SeedsGiveOtherTextures) {
  EXPECT_NE(TexturedWorld::furnished(1).grayAt({2.0, 0.1, 1.0}), TexturedWorld::furnished(2).grayAt({2.0, 0.1, 1.0}));
}

TEST(TexturedWorld, ColourHasTheBrightnessOfGrey) {
  const camera::RgbdFrame frame = TexturedWorld::furnished().render(texturedCamera(), kStart, recording::Channels::kColor);
  for (int v = 0; v < frame.gray.rows; v += 5) {
    for (int u = 0; u < frame.gray.cols; u += 5) {
      const cv::Vec3b bgr = frame.color.at<cv::Vec3b>(v, u);
      if (std::max({bgr[0], bgr[1], bgr[2]}) < 255) {
        EXPECT_NEAR(0.299 * bgr[2] + 0.587 * bgr[1] + 0.114 * bgr[0], frame.gray.at<unsigned char>(v, u), 1.5);
      }
    }
  }
}

TEST(SyntheticRecording, ReadsTheSameBytesAgain) {
  const SyntheticRecording recording = twoFrames({.gray_sigma = 3.0, .depth_sigma_scale = 1.0});
  const camera::RgbdFrame a = recording.read(1, recording::Channels::kColor);
  const camera::RgbdFrame b = recording.read(1, recording::Channels::kColor);
  EXPECT_TRUE(sameBytes(a.gray, b.gray));
  EXPECT_TRUE(sameBytes(a.color, b.color));
  EXPECT_TRUE(sameBytes(a.depth_m, b.depth_m));
  EXPECT_TRUE(recording.read(1, recording::Channels::kGray).color.empty());
  EXPECT_TRUE(sameBytes(recording.read(1, recording::Channels::kGray).gray, a.gray));
  EXPECT_FALSE(sameBytes(recording.read(0, recording::Channels::kGray).gray, a.gray));
}

TEST(SyntheticRecording, StampsAndTruthBelongTogether) {
  const SyntheticRecording recording = twoFrames({.rate_hz = 10.0});
  ASSERT_EQ(recording.truth().size(), 2U);
  EXPECT_EQ(recording.stampNs(1), 100'000'000);
  EXPECT_EQ(recording.truth()[1].stamp_ns, 100'000'000);
  EXPECT_TRUE(recording.truth()[1].T_map_camera.isApprox(kMoved, 1e-15));
  EXPECT_EQ(recording.read(1, recording::Channels::kGray).index, 1);
  EXPECT_THROW((void)recording.read(2, recording::Channels::kGray), base::ContractViolation);
}

TEST(SyntheticRecording, NoiseHasTheStatedDeviation) {
  const camera::RgbdFrame clean = twoFrames({}).read(0, recording::Channels::kGray);
  const camera::RgbdFrame noisy = twoFrames({.gray_sigma = 4.0, .depth_sigma_scale = 2.0}).read(0, recording::Channels::kGray);
  double gray_squares = 0.0;
  double depth_squares = 0.0;
  for (int v = 0; v < clean.gray.rows; ++v) {
    for (int u = 0; u < clean.gray.cols; ++u) {
      const auto depth_m = static_cast<double>(clean.depth_m.at<float>(v, u));
      gray_squares += std::pow(noisy.gray.at<unsigned char>(v, u) - clean.gray.at<unsigned char>(v, u), 2);
      depth_squares += std::pow((static_cast<double>(noisy.depth_m.at<float>(v, u)) - depth_m) / (2.0 * camera::depthSigma_m(depth_m)), 2);
    }
  }
  const auto pixels = static_cast<double>(clean.gray.total());
  EXPECT_NEAR(std::sqrt(gray_squares / pixels), 4.0, 0.1);
  EXPECT_NEAR(std::sqrt(depth_squares / pixels), 1.0, 0.02);
}

TEST(SyntheticRecording, ACoveredLensSeesNothing) {
  const camera::RgbdFrame frame = twoFrames({.blank_frames = {0}}).read(0, recording::Channels::kColor);
  EXPECT_EQ(cv::countNonZero(frame.gray != 128), 0);
  EXPECT_EQ(cv::countNonZero(frame.depth_m == frame.depth_m), 0);
  EXPECT_EQ(frame.color.at<cv::Vec3b>(5, 5), cv::Vec3b(128, 128, 128));
  EXPECT_GT(cv::countNonZero(twoFrames({.blank_frames = {0}}).read(1, recording::Channels::kGray).gray != 128), 1000);
}

TEST(SyntheticRecording, ReadingsEndAtTheSensorsRange) {
  const camera::RgbdFrame frame = twoFrames({.max_depth_m = 2.0}).read(0, recording::Channels::kGray);
  const int near = cv::countNonZero(frame.depth_m <= 2.0);
  const int far = static_cast<int>(frame.depth_m.total()) - cv::countNonZero(frame.depth_m == frame.depth_m);
  EXPECT_GT(near, 1000);
  EXPECT_GT(far, 1000);
  EXPECT_EQ(near + far, static_cast<int>(frame.depth_m.total()));
}

TEST(SyntheticRecording, RollingShutterRowsHaveTheirOwnPoses) {
  constexpr double kReadout_s = 0.02;
  const SyntheticRecording recording = twoFrames({.readout_s = kReadout_s});
  const camera::PinholeCamera camera = texturedCamera();
  const camera::RgbdFrame frame = recording.read(0, recording::Channels::kGray);
  for (const int row : {0, 60, 120, 239}) {
    const double time_s = (static_cast<double>(row) / camera.height - 0.5) * kReadout_s;
    const Eigen::Isometry3d T_map_camera = geometry::interpolate(kStart, kMoved, time_s * 30.0);
    const auto hit = recording.world().room().castRay(T_map_camera.translation(), T_map_camera.linear() * camera.ray(40, row));
    EXPECT_NEAR(frame.depth_m.at<float>(row, 40), hit.distance_m, 1e-5) << "row " << row;
  }
}

}  // namespace
}  // namespace oikos::test
