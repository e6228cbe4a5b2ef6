// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/depth_sensor.h"

#include <gtest/gtest.h>

#include <cstring>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "tests/core/camera/sensor/flat_scene.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"

namespace oikos::camera {
namespace {

using test::FlatScene;

constexpr PinholeCamera kCamera = {160, 120, 200.0, 200.0, 79.5, 59.5};

FlatScene makeScene() {
  FlatScene scene(kCamera);
  scene.addPlane(2.5, 0.6).addBoard({40, 30, 50, 50}, 1.2).addBoard({110, 20, 3, 80}, 1.5);
  return scene;
}

bool sameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

TEST(DepthSensor, KindsHaveNames) {
  test::checkEnumTable(DepthSensorKind::kKinect2);
}

TEST(DepthSensor, RulesOfTheConfiguration) {
  test::checkConfigRules<DepthSensorConfig>(
      {{"units_per_m", "0", "must be from 1 to 1e+05"}, {"scale_error", "0.5", "must be from -0.1 to 0.1"}});
  test::checkConfigRules<Kinect1Config>({{"baseline_m", "0", "must be from 0.01 to 1"},
                                         {"disparity_step_px", "2", "must be from 0.01 to 1"},
                                         {"agreement_px", "3", "must be from 0.1 to 2"},
                                         {"min_agreement", "1.5", "must be from 0.01 to 1"},
                                         {"noise_scale", "-1", "must be from 0 to 10"},
                                         {"noise_spacing_px", "0", "must be from 1 to 32"},
                                         {"min_signal", "0", "must be > 0"},
                                         {"min_cosine", "nan", "must be from 0.01 to 1"},
                                         {"dropout_softness", "2", "must be from 0 to 1"},
                                         {"dropout_spacing_px", "0", "must be from 1 to 64"},
                                         {"max_highlight", "0", "must be > 0"},
                                         {"min_range_m", "0", "must be from 0.1 to 10"},
                                         {"max_range_m", "0.25", "must be > 0.5"}});
  test::checkConfigRules<Kinect2Config>({{"noise_scale", "-1", "must be from 0 to 10"},
                                         {"reference_reflectivity", "0", "must be from 0.01 to 1"},
                                         {"edge_step_m", "0", "must be > 0"},
                                         {"edge_dropout", "2", "must be from 0 to 1"},
                                         {"min_signal", "0", "must be > 0"},
                                         {"min_cosine", "nan", "must be from 0.01 to 1"},
                                         {"dropout_softness", "2", "must be from 0 to 1"},
                                         {"min_range_m", "0", "must be from 0.1 to 10"},
                                         {"max_range_m", "0.25", "must be > 0.5"}});
}

TEST(DepthSensor, IdealReadingsAreTheTruthInUnits) {
  FlatScene scene(kCamera);
  scene.addBoard({0, 0, 80, 120}, 1.2345).addBoard({80, 0, 10, 120}, 14.0);
  DepthSensorConfig config;
  config.kind = DepthSensorKind::kIdeal;
  config.units_per_m = 5000.0;
  const cv::Mat stored = senseDepth(scene.view(), kCamera, config, {});
  ASSERT_EQ(stored.type(), CV_16UC1);
  EXPECT_EQ(stored.at<std::uint16_t>(60, 40), 6173);  // 6172.5
  EXPECT_EQ(stored.at<std::uint16_t>(60, 85), 0);     // 70000 does not fit
  EXPECT_EQ(stored.at<std::uint16_t>(60, 120), 0);    // nothing hit
}

class Kinds : public testing::TestWithParam<DepthSensorKind> {};

TEST_P(Kinds, SameBytesForAnyNumberOfThreadsAndOtherNoiseForAnotherSeedOrFrame) {
  const FlatScene scene = makeScene();
  DepthSensorConfig config;
  config.kind = GetParam();
  const cv::Mat one = senseDepth(scene.view(), kCamera, config, {9, 4, 1});
  for (const int threads : {2, 3}) {
    EXPECT_TRUE(sameBytes(one, senseDepth(scene.view(), kCamera, config, {9, 4, threads})));
  }
  EXPECT_FALSE(sameBytes(one, senseDepth(scene.view(), kCamera, config, {10, 4, 1})));
  EXPECT_FALSE(sameBytes(one, senseDepth(scene.view(), kCamera, config, {9, 5, 1})));
}

TEST_P(Kinds, AScaleErrorLengthensEveryReading) {
  const FlatScene scene = makeScene();
  DepthSensorConfig config;
  config.kind = GetParam();
  config.units_per_m = 10000.0;
  const cv::Mat exact = senseDepth(scene.view(), kCamera, config, {});
  config.scale_error = 0.005;
  const cv::Mat longer = senseDepth(scene.view(), kCamera, config, {});
  for (int v = 0; v < exact.rows; ++v) {
    for (int u = 0; u < exact.cols; ++u) {
      ASSERT_NEAR(longer.at<std::uint16_t>(v, u), 1.005 * exact.at<std::uint16_t>(v, u), 1.01);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Noisy, Kinds, testing::Values(DepthSensorKind::kKinect1, DepthSensorKind::kKinect2),
                         [](const auto& kind) { return std::string(base::toString(kind.param)); });

TEST(DepthSensor, NominalCameras) {
  EXPECT_EQ(nominalDepthCamera(DepthSensorKind::kKinect1).width, 640);
  EXPECT_EQ(nominalDepthCamera(DepthSensorKind::kKinect2).width, 512);
  EXPECT_EQ(nominalDepthCamera(DepthSensorKind::kKinect2).height, 424);
}

TEST(DepthSensor, WrongSizeOrTypeIsABug) {
  IdealView view = makeScene().view();
  view.gloss = cv::Mat(10, 10, CV_32FC1);
  EXPECT_THROW((void)senseDepth(view, kCamera, {}, {}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::camera
