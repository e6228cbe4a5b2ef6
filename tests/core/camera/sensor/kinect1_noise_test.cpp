// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <tuple>

#include "core/camera/sensor/kinect1.h"
#include "tests/core/camera/sensor/flat_scene.h"
#include "tests/core/camera/sensor/running_moments.h"

namespace oikos::camera {
namespace {

using test::FlatScene;
using test::RunningMoments;

constexpr double kRadian = std::numbers::pi / 180.0;
constexpr double kFocal_px = 525.0;
constexpr PinholeCamera kCamera = {200, 150, kFocal_px, kFocal_px, 99.5, 74.5};
constexpr int kFrames = 12;
/// Neighbours share their noise: as many pixels as a cell of the lattice has count as one.
constexpr double kPixelsPerNumber = 9.0;

double incidenceAngle(const FlatScene& scene, int u, int v) {
  const auto& n = scene.view().normal_camera.at<cv::Vec3f>(v, u);
  const Eigen::Vector3d ray = scene.camera().ray(u, v).normalized();
  return std::acos(-ray.dot(Eigen::Vector3d(n[0], n[1], n[2])));
}

/// The deviation of a quantised reading depends a little on where between two steps the truth lies: the frames' planes are spread evenly
/// over one step.
FlatScene sceneOfFrame(double z_m, double theta_rad, int frame) {
  const double focal_baseline = kFocal_px * 0.075;
  FlatScene scene(kCamera);
  scene.addPlane(focal_baseline / (focal_baseline / z_m + 0.125 * frame / kFrames), theta_rad);
  return scene;
}

/// Errors of the readings in units of the published deviation.
RunningMoments normalisedErrors(double z_m, double theta_rad) {
  RunningMoments errors;
  for (int frame = 0; frame < kFrames; ++frame) {
    const FlatScene scene = sceneOfFrame(z_m, theta_rad, frame);
    const cv::Mat depth_m = senseKinect1(scene.view(), scene.camera(), {}, {17, frame, 1});
    for (int v = 0; v < depth_m.rows; ++v) {
      for (int u = 0; u < depth_m.cols; ++u) {
        const auto truth_m = static_cast<double>(scene.view().depth_m.at<float>(v, u));
        const auto reading_m = static_cast<double>(depth_m.at<float>(v, u));
        if (truth_m > 0.65 && truth_m < 4.2 && !std::isnan(reading_m)) {
          errors.add((reading_m - truth_m) / kinect1AxialSigma_m(truth_m, incidenceAngle(scene, u, v)));
        }
      }
    }
  }
  return errors;
}

TEST(Kinect1Noise, TheModelIsThePublishedOne) {
  EXPECT_NEAR(kinect1AxialSigma_m(1.4, 0.0), 0.0012 + 0.0019, 1e-8);
  EXPECT_NEAR(kinect1AxialSigma_m(1.4, 59.0 * kRadian), 0.0012 + 0.0019, 1e-8);
  // 72 degrees: theta / (pi/2 - theta) = 4
  EXPECT_NEAR(kinect1AxialSigma_m(4.0, 72.0 * kRadian), 0.0012 + 0.0019 * 3.6 * 3.6 + 0.0001 / 2.0 * 16.0, 2e-6);
  EXPECT_NEAR(kinect1LateralSigma_px(0.0), 0.8, 1e-6);
  EXPECT_NEAR(kinect1LateralSigma_px(45.0 * kRadian), 0.8 + 0.035, 1e-4);
}

class Axial : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Axial, ErrorsHaveThePublishedDeviationAndNoBias) {
  const auto [z_m, theta_deg] = GetParam();
  const RunningMoments errors = normalisedErrors(z_m, theta_deg * kRadian);
  const double independent = errors.count / kPixelsPerNumber;
  ASSERT_GT(independent, 10000.0);
  EXPECT_NEAR(errors.deviation(), 1.0, 5.0 / std::sqrt(2.0 * independent) + 0.02);
  // the 0.01 are readings' 1/d, which is not linear: (sigma_d / d)² of z
  EXPECT_NEAR(errors.mean(), 0.0, 5.0 / std::sqrt(independent) + 0.01);
}

INSTANTIATE_TEST_SUITE_P(DistancesAndAngles, Axial, testing::Combine(testing::Values(1.0, 2.0, 3.0), testing::Values(0.0, 45.0, 70.0)));

TEST(Kinect1Noise, ReadingsLieOnStepsOfDisparity) {
  FlatScene scene(kCamera);
  scene.addPlane(2.0, 45.0 * kRadian);
  const cv::Mat depth_m = senseKinect1(scene.view(), kCamera, {}, {3, 0, 1});
  int checked = 0;
  for (const float reading_m : cv::Mat_<float>(depth_m)) {
    if (!std::isnan(reading_m)) {
      const double steps = kFocal_px * 0.075 / static_cast<double>(reading_m) / 0.125;
      ASSERT_NEAR(steps, std::round(steps), 1e-4);
      ++checked;
    }
  }
  EXPECT_GT(checked, 20000);
}

TEST(Kinect1Noise, WithoutNoiseAWallIsOffByHalfAStepAtMost) {
  Kinect1Config config;
  config.noise_scale = 0.0;
  for (const double z_m : {0.8, 1.7, 3.3}) {
    FlatScene scene(kCamera);
    scene.addPlane(z_m, 0.0);
    const cv::Mat depth_m = senseKinect1(scene.view(), kCamera, config, {3, 0, 1});
    const double step_m = z_m * z_m / (kFocal_px * 0.075) * 0.125;
    EXPECT_NEAR(static_cast<double>(depth_m.at<float>(75, 100)), z_m, 0.52 * step_m) << z_m;
  }
}

double shareOfReadings(const FlatScene& scene, const Kinect1Config& config = {}) {
  double readings = 0.0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const cv::Mat depth_m = senseKinect1(scene.view(), scene.camera(), config, {5, frame, 1});
    readings += cv::countNonZero(depth_m == depth_m);
  }
  return readings / (kFrames * (kCamera.width - 8.0) * (kCamera.height - 8.0));
}

/// A camera that sees all of a plane under nearly the same angle.
PinholeCamera narrowCamera() {
  return {200, 150, 4000.0, 4000.0, 99.5, 74.5};
}

TEST(Kinect1Dropout, FollowsTheReflectivity) {
  const Kinect1Config config;
  double before = 0.0;
  for (const double relative_signal : {0.5, 0.8, 1.0, 1.2, 1.5, 2.5}) {
    FlatScene scene(narrowCamera());
    scene.addPlane(2.0, 0.0, relative_signal * config.min_signal * 4.0);
    const double share = shareOfReadings(scene);
    const double expected = 0.5 * std::erfc(-(relative_signal - 1.0) / config.dropout_softness / std::numbers::sqrt2);
    const double independent = kFrames * 192.0 * 142.0 / (config.dropout_spacing_px * config.dropout_spacing_px);
    EXPECT_NEAR(share, expected, 5.0 * std::sqrt(0.25 / independent) + 0.003) << relative_signal;
    EXPECT_GT(share, before);
    before = share;
  }
}

TEST(Kinect1Dropout, RisesWithTheAngle) {
  double before = 1.1;
  for (const double theta_deg : {70.0, 76.0, 79.0, 81.0, 83.0}) {
    FlatScene scene(narrowCamera());
    Kinect1Config config;
    config.baseline_m = 0.02;  // with the slope that the window bears, only the angle counts
    scene.addPlane(2.0, theta_deg * kRadian);
    const double share = shareOfReadings(scene, config);
    EXPECT_LT(share, before) << theta_deg;
    before = share;
  }
  EXPECT_LT(before, 0.25);
}

TEST(Kinect1Dropout, MirrorsAndHighlightsGiveNothing) {
  FlatScene mirror(kCamera);
  mirror.addPlane(1.5, 30.0 * kRadian).setGloss(1.0);
  EXPECT_EQ(shareOfReadings(mirror), 0.0);
  FlatScene whiteboard(kCamera);
  whiteboard.addPlane(1.7, 15.0 * kRadian).setGloss(0.6);
  const cv::Mat depth_m = senseKinect1(whiteboard.view(), kCamera, {}, {1, 0, 1});
  for (int u = 5; u < kCamera.width - 5; ++u) {
    const double theta_deg = incidenceAngle(whiteboard, u, 75) / kRadian;
    if (theta_deg < 9.0 || theta_deg > 12.0) {
      EXPECT_EQ(std::isnan(depth_m.at<float>(75, u)), theta_deg < 9.0) << theta_deg;
    }
  }
}

TEST(Kinect1Range, OutsideThereIsNoReading) {
  for (const auto& [z_m, expected] : {std::pair(0.45, 0.0), {0.55, 1.0}, {4.2, 1.0}, {5.0, 0.0}, {20.0, 0.0}}) {
    FlatScene scene(narrowCamera());
    scene.addPlane(z_m, 0.0, 1.0);
    EXPECT_NEAR(shareOfReadings(scene), expected, 0.002) << z_m;
  }
  EXPECT_EQ(shareOfReadings(FlatScene(kCamera)), 0.0);
}

}  // namespace
}  // namespace oikos::camera
