// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/auto_exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "tests/support/config_rules_check.h"

namespace oikos::camera {
namespace {

/// Exposure products of a camera before a scene of this radiance: light is radiance times exposure, up to saturation.
std::vector<double> follow(AutoExposure& exposure, double radiance_per_s, int frames) {
  std::vector<double> products_s;
  for (int i = 0; i < frames; ++i) {
    products_s.push_back(exposure.current().product_s());
    exposure.observe(std::min(1.0, radiance_per_s * products_s.back()));
  }
  return products_s;
}

TEST(AutoExposure, RulesOfTheConfiguration) {
  test::checkConfigRules<AutoExposureConfig>({{"target_light", "0", "must be from 0.01 to 0.9"},
                                              {"speed", "2", "must be from 0 to 1"},
                                              {"lag_frames", "-1", "must be from 0 to 30"},
                                              {"tolerance_stops", "-1", "must be >= 0"},
                                              {"max_step_stops", "0", "must be > 0"},
                                              {"min_time_s", "0", "must be > 0"},
                                              {"max_time_s", "1e-04", "must be >= 5e-04"},
                                              {"max_gain", "0.5", "must be from 1 to 1000"}});
}

TEST(AutoExposure, SettlesAtTheTargetFromBothSides) {
  const AutoExposureConfig config;
  for (const double radiance_per_s : {4.0, 15.0, 60.0, 150.0}) {
    AutoExposure exposure(config, {0.012, 1.0});
    const double light = radiance_per_s * follow(exposure, radiance_per_s, 60).back();
    EXPECT_NEAR(std::log2(light / config.target_light), 0.0, config.tolerance_stops + 1e-9) << radiance_per_s;
  }
}

TEST(AutoExposure, ADecisionShowsAfterTheLag) {
  AutoExposureConfig config;
  config.lag_frames = 3;
  AutoExposure exposure(config, {0.012, 1.0});
  const std::vector<double> products_s = follow(exposure, config.target_light / 0.012 / 2.0, 6);  // one stop too dark
  for (int i = 0; i <= 3; ++i) {
    EXPECT_NEAR(products_s[static_cast<std::size_t>(i)], 0.012, 1e-12) << i;
  }
  EXPECT_NEAR(std::log2(products_s[4] / products_s[3]), config.speed * 1.0, 1e-9);
}

TEST(AutoExposure, AStepOfTheSceneIsFollowedInSteps) {
  AutoExposureConfig config;
  AutoExposure exposure(config, {0.012, 1.0});
  const std::vector<double> products_s = follow(exposure, 1000.0, 40);
  for (std::size_t i = 1; i < products_s.size(); ++i) {
    EXPECT_LE(std::abs(std::log2(products_s[i] / products_s[i - 1])), config.max_step_stops + 1e-9);
  }
}

TEST(AutoExposure, GainTakesOverWhereTimeEnds) {
  const AutoExposureConfig config;
  AutoExposure exposure(config, {0.012, 1.0});
  follow(exposure, config.target_light / (config.max_time_s * 4.0), 80);
  EXPECT_DOUBLE_EQ(exposure.current().time_s, config.max_time_s);
  EXPECT_NEAR(std::log2(exposure.current().gain), 2.0, config.tolerance_stops + 1e-9);
  follow(exposure, 1e-6, 200);
  EXPECT_NEAR(exposure.current().gain, config.max_gain, 1e-9);
  follow(exposure, 1e6, 200);
  EXPECT_NEAR(exposure.current().time_s, config.min_time_s, 1e-12);
  EXPECT_DOUBLE_EQ(exposure.current().gain, 1.0);
}

TEST(MeanLight, IsTheMeanOfTheLightNotOfTheBytes) {
  cv::Mat color(40, 40, CV_8UC3, cv::Scalar(0, 0, 0));
  color.colRange(20, 40) = cv::Scalar(255, 255, 255);
  EXPECT_NEAR(measureMeanLight(color), 0.5, 1e-6);
  color = cv::Scalar(188, 188, 188);
  EXPECT_NEAR(measureMeanLight(color), 0.5, 0.005);
}

}  // namespace
}  // namespace oikos::camera
