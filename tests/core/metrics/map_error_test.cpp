// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/map_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/base/error.h"

namespace oikos::metrics {
namespace {

using Points = std::vector<Eigen::Vector3f>;

Points randomPoints(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate_m(-1.0F, 1.0F);
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(coordinate_m(random), coordinate_m(random), coordinate_m(random));
  }
  return points;
}

double slowMeanDistance(const Points& from, const Points& to) {
  double sum_m = 0.0;
  for (const Eigen::Vector3f& point : from) {
    double least_m = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3f& other : to) {
      least_m = std::min(least_m, (point.cast<double>() - other.cast<double>()).norm());
    }
    sum_m += least_m;
  }
  return sum_m / static_cast<double>(from.size());
}

// Cloud: 1 cm, 3 cm and 10 cm beside a reference point. The reference's last point was never mapped: it is 1 m from the cloud.
TEST(MapError, HandComputedCase) {
  const Points cloud = {{0.01F, 0, 0}, {1, 0.03F, 0}, {2, 0, 0.10F}};
  const Points reference = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 1.10F}};
  const MapError result = evaluateMap(cloud, reference);
  ASSERT_EQ(result.status, MapErrorStatus::kEvaluated);
  EXPECT_EQ(result.accuracy.distance_m.count, 3);
  EXPECT_NEAR(result.accuracy.distance_m.mean, 0.14 / 3.0, 1e-7);
  EXPECT_NEAR(result.accuracy.distance_m.median, 0.03, 1e-7);
  EXPECT_NEAR(result.accuracy.distance_m.rmse, std::sqrt((0.0001 + 0.0009 + 0.01) / 3.0), 1e-7);
  EXPECT_NEAR(result.accuracy.distance_m.max, 0.10, 1e-7);
  EXPECT_DOUBLE_EQ(result.accuracy.share_within_fine, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(result.accuracy.share_within_coarse, 2.0 / 3.0);
  EXPECT_EQ(result.completeness.distance_m.count, 4);
  EXPECT_NEAR(result.completeness.distance_m.median, 0.065, 1e-7);
  EXPECT_NEAR(result.completeness.distance_m.max, 1.0, 1e-6);
  EXPECT_DOUBLE_EQ(result.completeness.share_within_fine, 0.25);
  EXPECT_DOUBLE_EQ(result.completeness.share_within_coarse, 0.5);
}

TEST(MapError, AgreesWithTryingEveryPairAndWithAnyNumberOfThreads) {
  const Points cloud = randomPoints(9000, 1);
  const Points reference = randomPoints(700, 2);
  const MapError one = evaluateMap(cloud, reference);
  const MapError three = evaluateMap(cloud, reference, {.threads = 3});
  EXPECT_NEAR(one.accuracy.distance_m.mean, slowMeanDistance(cloud, reference), 1e-12);
  EXPECT_NEAR(one.completeness.distance_m.mean, slowMeanDistance(reference, cloud), 1e-12);
  EXPECT_EQ(one.accuracy.distance_m.rmse, three.accuracy.distance_m.rmse);
  EXPECT_EQ(one.accuracy.distance_m.median, three.accuracy.distance_m.median);
  EXPECT_EQ(one.accuracy.share_within_coarse, three.accuracy.share_within_coarse);
}

TEST(MapError, ACloudIsItsOwnPerfectReference) {
  const Points cloud = randomPoints(100, 3);
  const MapError result = evaluateMap(cloud, cloud);
  EXPECT_EQ(result.accuracy.distance_m.max, 0.0);
  EXPECT_EQ(result.completeness.share_within_fine, 1.0);
}

TEST(MapError, EveryOtherStatus) {
  const Points some = randomPoints(3, 4);
  Points broken = some;
  broken[1].z() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(evaluateMap({}, some).status, MapErrorStatus::kEmptyCloud);
  EXPECT_EQ(evaluateMap(some, {}).status, MapErrorStatus::kEmptyReference);
  EXPECT_EQ(evaluateMap(broken, some).status, MapErrorStatus::kNonFinite);
  EXPECT_EQ(evaluateMap(some, broken).status, MapErrorStatus::kNonFinite);
}

TEST(MapError, ConfigurationSaysWhatIsWrong) {
  const MapErrorConfig wrong{.fine_m = -1.0, .threads = 0};
  ASSERT_EQ(wrong.validate().size(), 2U);
  EXPECT_EQ(wrong.validate()[0], "map_error.fine_m = -1: must be > 0");
  EXPECT_THROW(static_cast<void>(evaluateMap({}, {}, wrong)), base::ContractViolation);
}

TEST(MapError, StatusNamesRoundTrip) {
  for (const std::string& name : base::enumNames<MapErrorStatus>()) {
    EXPECT_EQ(base::toString(*base::findEnum<MapErrorStatus>(name)), name);
  }
}

}  // namespace
}  // namespace oikos::metrics
