// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_fusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/base/error.h"
#include "tests/support/config_rules_check.h"

namespace oikos::registration {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSigma_rad = 1.0 * kDegree;
constexpr double kShared_rad = 0.3 * kDegree;

/// An image that has found a door at `value_deg`, from a place of its own.
JointSighting sightingOf(double value_deg, int number, double sigma_rad = kSigma_rad) {
  JointSighting sighting;
  sighting.stamp_ns = number * 100'000'000LL;
  sighting.T_map_camera.translation().x() = number;
  sighting.status = JointStatus::kFound;
  sighting.confidence = 0.999;
  sighting.evidence.is_turn = true;
  sighting.evidence.has_peak = true;
  sighting.evidence.value = value_deg * kDegree;
  sighting.evidence.variance = sigma_rad * sigma_rad;
  sighting.evidence.shared_variance = kShared_rad * kShared_rad;
  for (int i = 0; i <= 36; ++i) {
    const double off_deg = 2.5 * i - value_deg;
    sighting.evidence.values.push_back(2.5 * kDegree * i);
    sighting.evidence.log_likelihood.push_back(20.0 - std::min(20.0, 0.5 * off_deg * off_deg / 6.25));
  }
  return sighting;
}

/// One that sees the joint but can tell nothing.
JointSighting blankSighting(int number) {
  JointSighting sighting = sightingOf(0.0, number);
  sighting.status = JointStatus::kHidden;
  sighting.evidence.log_likelihood.assign(sighting.evidence.values.size(), 0.0);
  return sighting;
}

std::vector<JointSighting> doorAt(const std::vector<double>& values_deg) {
  std::vector<JointSighting> sightings;
  for (const double value_deg : values_deg) {
    sightings.push_back(sightingOf(value_deg, static_cast<int>(sightings.size())));
  }
  return sightings;
}

TEST(JointFusion, NothingSeenNothingSaid) {
  EXPECT_TRUE(fuse({}, {}).empty());
  const JointSighting unseen;
  EXPECT_TRUE(fuse({unseen}, {}).empty());
}

/// A camera that stands still repeats itself, but not what contradicts it: the more often it has seen the door shut, the less it may
/// overlook that it is open now.
TEST(JointFusion, FromOnePlaceAChangeIsSeenHoweverManyImagesWentBefore) {
  for (const int before : {3, 8, 20}) {
    std::vector<double> values_deg(static_cast<std::size_t>(before), 0.0);
    values_deg.insert(values_deg.end(), {76.0, 76.0});
    std::vector<JointSighting> sightings = doorAt(values_deg);
    for (JointSighting& sighting : sightings) {
      sighting.T_map_camera.setIdentity();
    }
    const std::vector<JointSpan> spans = fuse(sightings, {});
    ASSERT_EQ(spans.size(), 2U) << before;
    EXPECT_EQ(spans[1].first, static_cast<std::size_t>(before));
    EXPECT_NEAR(spans[1].value, 76.0 * kDegree, 1.0 * kDegree);
  }
}

TEST(JointFusion, AMisreadingAmongImagesFromOnePlaceIsNoChange) {
  std::vector<JointSighting> sightings = doorAt({0.0, 0.0, 0.0, 76.0, 0.0, 0.0, 0.0, 0.0});
  for (JointSighting& sighting : sightings) {
    sighting.T_map_camera.setIdentity();
  }
  ASSERT_EQ(fuse(sightings, {}).size(), 1U);
}

TEST(JointFusion, OneImageIsItself) {
  const std::vector<JointSpan> spans = fuse({sightingOf(33.0, 0)}, {});
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0].status, JointStatus::kFound);
  EXPECT_NEAR(spans[0].value, 33.0 * kDegree, 0.05 * kDegree);
  EXPECT_NEAR(std::sqrt(spans[0].variance), std::hypot(kSigma_rad, kShared_rad), 0.1 * kDegree);
}

/// Independent images: the mean, with the variance of a mean; the joint's axis is no better known than before.
TEST(JointFusion, ImagesFromManyPlacesNarrowItDown) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<double> values_deg;
  double mean_deg = 0.0;
  for (int i = 0; i < 16; ++i) {
    values_deg.push_back(40.0 + noise(random));
    mean_deg += values_deg.back() / 16.0;
  }
  const std::vector<JointSpan> spans = fuse(doorAt(values_deg), {});
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_NEAR(spans[0].value, mean_deg * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(spans[0].variance, kSigma_rad * kSigma_rad / 16.0 + kShared_rad * kShared_rad, 0.03 * kDegree * kDegree);
}

/// From one place n images count for n / (1 + (n - 1) * repeated).
TEST(JointFusion, ImagesFromOnePlaceRepeatEachOther) {
  std::vector<JointSighting> sightings = doorAt(std::vector<double>(21, 40.0));
  for (JointSighting& sighting : sightings) {
    sighting.T_map_camera = Eigen::Isometry3d::Identity();
  }
  const std::vector<JointSpan> spans = fuse(sightings, {});
  ASSERT_EQ(spans.size(), 1U);
  const double counted = 21.0 / (1.0 + 20.0 * 0.2);
  EXPECT_NEAR(spans[0].variance, kSigma_rad * kSigma_rad / counted + kShared_rad * kShared_rad, 0.03 * kDegree * kDegree);
}

TEST(JointFusion, TheMomentOfAChangeIsFound) {
  std::vector<double> values_deg(12, 0.5);
  values_deg.insert(values_deg.end(), 9, 60.0);
  values_deg.insert(values_deg.end(), 7, 25.0);
  const std::vector<JointSpan> spans = fuse(doorAt(values_deg), {});
  ASSERT_EQ(spans.size(), 3U);
  EXPECT_EQ(spans[0].first, 0U);
  EXPECT_EQ(spans[0].last, 11U);
  EXPECT_EQ(spans[1].first, 12U);
  EXPECT_EQ(spans[1].last, 20U);
  EXPECT_EQ(spans[2].last, 27U);
  EXPECT_EQ(spans[1].first_ns, 1'200'000'000);
  EXPECT_EQ(spans[1].last_ns, 2'000'000'000);
  EXPECT_NEAR(spans[0].value, 0.5 * kDegree, 0.2 * kDegree);
  EXPECT_NEAR(spans[1].value, 60.0 * kDegree, 0.2 * kDegree);
  EXPECT_NEAR(spans[2].value, 25.0 * kDegree, 0.2 * kDegree);
}

TEST(JointFusion, OneMisreadImageIsNoChange) {
  std::vector<double> values_deg(15, 30.0);
  values_deg[6] = 80.0;
  const std::vector<JointSpan> spans = fuse(doorAt(values_deg), {});
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_NEAR(spans[0].value, 30.0 * kDegree, 0.2 * kDegree);
  EXPECT_EQ(spans[0].status, JointStatus::kFound);
}

TEST(JointFusion, NoiseIsNoChange) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<double> values_deg;
  for (int i = 0; i < 60; ++i) {
    values_deg.push_back(45.0 + noise(random));
  }
  EXPECT_EQ(fuse(doorAt(values_deg), {}).size(), 1U);
}

TEST(JointFusion, ImagesThatTellNothingChangeNothing) {
  std::vector<JointSighting> sightings = doorAt({20.0, 20.0, 20.0});
  for (int i = 3; i < 9; ++i) {
    sightings.push_back(blankSighting(i));
  }
  const std::vector<JointSpan> spans = fuse(sightings, {});
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0].last, 8U);
  EXPECT_NEAR(spans[0].value, 20.0 * kDegree, 0.2 * kDegree);
  const std::vector<JointSpan> alone = fuse({blankSighting(0), blankSighting(1)}, {});
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_EQ(alone[0].status, JointStatus::kNotObservable);
}

/// What each image could not tell by itself is not found because there are many of them.
TEST(JointFusion, UnsureImagesDoNotAddUp) {
  std::vector<JointSighting> sightings = doorAt({20.0, 20.0, 20.0, 20.0, 20.0, 20.0});
  for (JointSighting& sighting : sightings) {
    sighting.status = JointStatus::kNotObservable;
  }
  const std::vector<JointSpan> spans = fuse(sightings, {});
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0].status, JointStatus::kNotObservable);
  sightings[3].status = JointStatus::kFound;
  EXPECT_EQ(fuse(sightings, {})[0].status, JointStatus::kFound);
}

/// Two halves of what an image left open, each told by another one.
TEST(JointFusion, AnAmbiguousImageIsSettledByAnother) {
  JointSighting either = blankSighting(0);
  either.status = JointStatus::kAmbiguous;
  for (std::size_t i = 0; i < either.evidence.values.size(); ++i) {
    const bool is_one = i == 8 || i == 24;
    either.evidence.log_likelihood[i] = is_one ? 30.0 : 0.0;
  }
  const std::vector<JointSpan> open = fuse({either}, {});
  ASSERT_EQ(open.size(), 1U);
  EXPECT_EQ(open[0].status, JointStatus::kAmbiguous);
  const JointSighting rough = sightingOf(58.0, 1, 2.5 * kDegree);
  const std::vector<JointSpan> settled = fuse({either, rough}, {});
  ASSERT_EQ(settled.size(), 1U);
  EXPECT_NEAR(settled[0].value, 60.0 * kDegree, 1.5 * kDegree);
}

TEST(JointFusion, BrokenContracts) {
  std::vector<JointSighting> sightings = doorAt({1.0, 2.0});
  std::swap(sightings[0], sightings[1]);
  EXPECT_THROW((void)fuse(sightings, {}), base::ContractViolation);
  sightings = doorAt({1.0, 2.0});
  sightings[1].evidence.values.back() += 0.1;
  EXPECT_THROW((void)fuse(sightings, {}), base::ContractViolation);
  JointFusionConfig config;
  config.misread = 0.0;
  EXPECT_THROW((void)fuse(doorAt({1.0}), config), base::ContractViolation);
}

TEST(JointFusion, ConfigurationRules) {
  test::checkConfigRules<JointFusionConfig>({{"repeated", "2", "must be from 0 to 1"},
                                             {"same_view_m", "-1", "must be >= 0"},
                                             {"same_view_deg", "-1", "must be >= 0"},
                                             {"misread", "0", "must be > 0 and < 1"},
                                             {"misread_unsure", "1", "must be > 0 and < 1"},
                                             {"change_cost", "-1", "must be >= 0"},
                                             {"bin_deg", "0", "must be > 0"},
                                             {"bin_m", "0", "must be > 0"}});
}

}  // namespace
}  // namespace oikos::registration
