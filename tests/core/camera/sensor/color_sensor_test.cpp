// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/color_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/geometry/tone_curve.h"
#include "tests/core/camera/sensor/running_moments.h"
#include "tests/support/config_rules_check.h"

namespace oikos::camera {
namespace {

using test::RunningMoments;

constexpr PinholeCamera kCamera = {320, 240, 250.0, 250.0, 159.5, 119.5};

ColorScene evenScene(double light) {
  return {kCamera, cv::Mat(240, 320, CV_32FC3, cv::Scalar(light, light, light)), cv::Mat(240, 320, CV_32FC1, cv::Scalar(2.0))};
}

/// No noise, no vignetting.
ColorSensorConfig plainSensor() {
  ColorSensorConfig config;
  config.vignetting = 0.0;
  config.full_well_e = 0.0;
  return config;
}

double lightAt(const cv::Mat& color, int u, int v) {
  return static_cast<double>(geometry::ToneCurve::instance().toLight(color.at<cv::Vec3b>(v, u)[1]));
}

TEST(ColorSensor, RulesOfTheConfiguration) {
  test::checkConfigRules<ColorSensorConfig>({{"reference_exposure_s", "0", "must be > 0"},
                                             {"vignetting", "2", "must be from 0 to 1"},
                                             {"full_well_e", "-1", "must be >= 0"},
                                             {"read_noise_e", "-1", "must be >= 0"},
                                             {"blur_samples", "0", "must be from 1 to 64"}});
}

TEST(ColorSensor, ReproducesTheIdealImageAtTheReferenceExposure) {
  cv::Mat color(240, 320, CV_8UC3);
  for (int v = 0; v < color.rows; ++v) {
    for (int u = 0; u < color.cols; ++u) {
      color.at<cv::Vec3b>(v, u) = cv::Vec3b(static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(u ^ v));
    }
  }
  const cv::Mat recorded = senseColor({kCamera, color, {}}, {}, plainSensor(), {});
  EXPECT_EQ(cv::norm(color, recorded, cv::NORM_INF), 0.0);
}

TEST(ColorSensor, ExposureAndGainMultiplyTheLight) {
  for (const Exposure& exposure : {Exposure{0.024, 1.0}, Exposure{0.006, 4.0}}) {
    const cv::Mat recorded = senseColor(evenScene(0.2), {exposure, {}}, plainSensor(), {});
    EXPECT_NEAR(lightAt(recorded, 100, 100), 0.4, 0.003);
  }
  EXPECT_DOUBLE_EQ(lightAt(senseColor(evenScene(0.7), {{0.024, 1.0}, {}}, plainSensor(), {}), 5, 5), 1.0);
}

TEST(ColorSensor, VignettingFollowsCosineToTheFourth) {
  ColorSensorConfig config = plainSensor();
  for (const double strength : {0.5, 1.0}) {
    config.vignetting = strength;
    const cv::Mat recorded = senseColor(evenScene(0.5), {}, config, {});
    for (const cv::Point& pixel : {cv::Point(159, 119), {0, 0}, {319, 120}, {250, 30}}) {
      const double cosine = 1.0 / kCamera.ray(pixel.x, pixel.y).norm();
      const double expected = 0.5 * (1.0 - strength + strength * std::pow(cosine, 4.0));
      EXPECT_NEAR(lightAt(recorded, pixel.x, pixel.y), expected, 0.004) << pixel.x << "," << pixel.y;
    }
  }
}

TEST(ColorNoise, VarianceIsPoissonPlusRead) {
  ColorSensorConfig config;
  config.full_well_e = 1000.0;
  config.read_noise_e = 20.0;
  EXPECT_NEAR(colorNoiseSigma(0.5, 1.0, config), std::sqrt(0.5 * 1000.0 + 400.0) / 1000.0, 1e-7);
  EXPECT_NEAR(colorNoiseSigma(0.5, 4.0, config), std::sqrt(0.5 * 250.0 + 400.0) / 250.0, 1e-7);
  EXPECT_EQ(colorNoiseSigma(0.5, 4.0, plainSensor()), 0.0);
}

class Brightness : public testing::TestWithParam<double> {};

TEST_P(Brightness, RecordedNoiseHasTheModelsDeviation) {
  const double light = GetParam();
  ColorSensorConfig config;
  config.vignetting = 0.0;
  for (const double gain : {1.0, 4.0}) {
    const cv::Mat recorded = senseColor(evenScene(light), {{0.012 / gain, gain}, {}}, config, {3, 1, 1});
    RunningMoments channels[3];
    RunningMoments between;
    const geometry::ToneCurve& curve = geometry::ToneCurve::instance();
    for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(recorded)) {
      for (int c = 0; c < 3; ++c) {
        channels[c].add(static_cast<double>(curve.toLight(pixel[c])) - light);
      }
      between.add((static_cast<double>(curve.toLight(pixel[0])) - light) * (static_cast<double>(curve.toLight(pixel[1])) - light));
    }
    const double sigma = colorNoiseSigma(light, gain, config);
    const double independent = channels[0].count;
    for (const RunningMoments& channel : channels) {
      EXPECT_NEAR(channel.deviation() / sigma, 1.0, 5.0 / std::sqrt(2.0 * independent) + 0.03);  // 3 %: rounding to bytes
      EXPECT_NEAR(channel.mean() / sigma, 0.0, 5.0 / std::sqrt(independent) + 0.03);
    }
    EXPECT_NEAR(between.mean() / (sigma * sigma), 0.0, 5.0 / std::sqrt(independent) + 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Brightness, testing::Values(0.05, 0.2, 0.5, 0.8));

TEST(ColorSensor, SameBytesForAnyNumberOfThreadsAndOtherNoiseForAnotherSeedOrFrame) {
  ColorShot shot;
  geometry::Vector6d twist_camera;
  twist_camera << 0.2, 0.1, 0.3, 0.1, 0.6, 0.2;
  shot.motion = makeSteadyMotion(twist_camera, 0.02, kCamera.height);
  const ColorScene scene = evenScene(0.3);
  const auto sense = [&](const SensorRun& run) { return senseColor(scene, shot, {}, run); };
  const cv::Mat one = sense({5, 7, 1});
  const auto differ = [&](const cv::Mat& other) { return std::memcmp(one.data, other.data, one.total() * one.elemSize()) != 0; };
  EXPECT_FALSE(differ(sense({5, 7, 2})));
  EXPECT_FALSE(differ(sense({5, 7, 3})));
  EXPECT_TRUE(differ(sense({6, 7, 1})));
  EXPECT_TRUE(differ(sense({5, 8, 1})));
}

TEST(ColorSensor, WrongSizesAreABug) {
  ColorScene scene = evenScene(0.3);
  scene.depth_m = cv::Mat();
  EXPECT_NO_THROW((void)senseColor(scene, {}, {}, {}));
  ColorShot shot;
  shot.motion.twist_camera[0] = 1.0;
  EXPECT_THROW((void)senseColor(scene, shot, {}, {}), base::ContractViolation);
  scene.color = cv::Mat(240, 320, CV_8UC1);
  EXPECT_THROW((void)senseColor(scene, {}, {}, {}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::camera
