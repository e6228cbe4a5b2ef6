// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/features.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <set>
#include <utility>

#include "tests/support/enum_table_check.h"
#include "tests/support/textured_world.h"

namespace oikos::mapping {
namespace {

const test::TexturedWorld kWorld = test::TexturedWorld::furnished();
const camera::PinholeCamera kCamera{640, 480, 532.0, 532.0, 319.5, 239.5};
const Eigen::Isometry3d T_map_a = test::lookAt({-1.2, 0.1, 1.2}, {1.0, 0.0, 0.8});
const Eigen::Isometry3d T_map_b = test::lookAt({-1.1, 0.25, 1.15}, {1.0, 0.1, 0.8});

/// Rendered once: the same for all tests.
const camera::RgbdFrame& frameA() {
  static const camera::RgbdFrame frame = kWorld.render(kCamera, T_map_a);
  return frame;
}

const camera::RgbdFrame& frameB() {
  static const camera::RgbdFrame frame = kWorld.render(kCamera, T_map_b);
  return frame;
}

Descriptor bits(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0, std::uint64_t d = 0) {
  return {a, b, c, d};
}

/// Features that are nothing but their descriptors.
Features described(const std::vector<Descriptor>& descriptors) {
  Features features;
  features.descriptor = descriptors;
  features.pixel.resize(descriptors.size());
  features.point_camera.resize(descriptors.size());
  return features;
}

TEST(FeatureType, TableIsComplete) {
  test::checkEnumTable(FeatureType::kOrb);
}

TEST(HammingDistance, CountsDifferentBits) {
  EXPECT_EQ(hammingDistance(bits(0), bits(0)), 0);
  EXPECT_EQ(hammingDistance(bits(0b1011), bits(0b0001)), 2);
  EXPECT_EQ(hammingDistance(bits(1, 1, 1, 1), bits(0, 0, 0, 0)), 4);
  EXPECT_EQ(hammingDistance(bits(~0ULL, ~0ULL, ~0ULL, ~0ULL), bits(0, 0, 0, 0)), 256);
}

TEST(MatchFeatures, PairsMutualNearestNeighbours) {
  const Features a = described({bits(0xFF), bits(0xFF00), bits(0xFF0000)});
  const Features b = described({bits(0xFF0001), bits(0xFF)});
  const auto matches = matchFeatures(a, b);
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_EQ(matches[0].a, 0);
  EXPECT_EQ(matches[0].b, 1);
  EXPECT_EQ(matches[0].distance, 0);
  EXPECT_EQ(matches[1].a, 2);
  EXPECT_EQ(matches[1].b, 0);
  EXPECT_EQ(matches[1].distance, 1);
}

TEST(MatchFeatures, OneSidedNeighboursAreNoMatch) {
  // Both of a are nearest to b's only one, which is nearer to the second.
  const auto matches = matchFeatures(described({bits(0x7), bits(0x1)}), described({bits(0)}));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].a, 1);
}

TEST(MatchFeatures, AmbiguousOnesFailTheRatio) {
  const Features a = described({bits(0)});
  const Features b = described({bits(0x3FF), bits(0x7FF, 0)});  // 10 and 11 bits away
  EXPECT_TRUE(matchFeatures(a, b, 80, 0.9).empty());
  EXPECT_EQ(matchFeatures(a, b, 80, 0.95).size(), 1U);
}

TEST(MatchFeatures, FarOnesAreNoMatch) {
  const Features a = described({bits(0)});
  const Features b = described({bits(0xFF)});
  EXPECT_EQ(matchFeatures(a, b, 8).size(), 1U);
  EXPECT_TRUE(matchFeatures(a, b, 7).empty());
}

TEST(MatchFeatures, NothingMatchesNothing) {
  EXPECT_TRUE(matchFeatures({}, {}).empty());
  EXPECT_TRUE(matchFeatures(described({bits(1)}), {}).empty());
  EXPECT_TRUE(matchFeatures({}, described({bits(1)})).empty());
}

class FeaturesOf : public ::testing::TestWithParam<FeatureType> {
 protected:
  static FeatureConfig config() {
    FeatureConfig config;
    config.type = GetParam();
    return config;
  }
};

TEST_P(FeaturesOf, AreSpreadOverTheImage) {
  const Features features = extractFeatures(frameA(), kCamera, config());
  EXPECT_LE(features.size(), config().count);
  EXPECT_GT(features.size(), config().count / 2);
  std::set<std::pair<int, int>> cells;
  for (const Eigen::Vector2d& px : features.pixel) {
    EXPECT_TRUE(kCamera.contains(px));
    cells.insert({static_cast<int>(px.x()) / 80, static_cast<int>(px.y()) / 80});
  }
  EXPECT_GE(cells.size(), 38U) << "of 48";
}

TEST_P(FeaturesOf, AreLiftedByTheirDepth) {
  const Features features = extractFeatures(frameA(), kCamera, config());
  ASSERT_EQ(features.point_camera.size(), features.pixel.size());
  ASSERT_EQ(features.descriptor.size(), features.pixel.size());
  int near_surface = 0;
  for (std::size_t i = 0; i < features.pixel.size(); ++i) {
    EXPECT_LT((kCamera.project(features.point_camera[i]) - features.pixel[i]).norm(), 1e-9);
    near_surface += kWorld.room().distanceToSurface(T_map_a * features.point_camera[i]) < 0.01 ? 1 : 0;
  }
  EXPECT_GE(near_surface, 0.97 * features.size());  // medians about edges may be off
}

TEST_P(FeaturesOf, MatchAcrossViews) {
  const Features a = extractFeatures(frameA(), kCamera, config());
  const Features b = extractFeatures(frameB(), kCamera, config());
  const auto matches = matchFeatures(a, b);
  int right = 0;
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector3d p_a = T_map_a.inverse() * T_map_b * b.point_camera[static_cast<std::size_t>(match.b)];
    right += (p_a - a.point_camera[static_cast<std::size_t>(match.a)]).norm() < 0.03 ? 1 : 0;
    EXPECT_LE(match.distance, 80);
  }
  EXPECT_GT(matches.size(), 60U);
  EXPECT_GT(right, 0.7 * static_cast<double>(matches.size())) << right << " of " << matches.size();
}

TEST_P(FeaturesOf, WithoutDepthThereIsNone) {
  camera::RgbdFrame frame = frameA();
  frame.depth_m = cv::Mat(frame.depth_m.size(), CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(extractFeatures(frame, kCamera, config()).size(), 0);
}

TEST_P(FeaturesOf, FarOnesAreDropped) {
  FeatureConfig near = config();
  near.max_depth_m = 2.0;
  const Features features = extractFeatures(frameA(), kCamera, near);
  EXPECT_GT(features.size(), 10);
  for (const Eigen::Vector3d& p : features.point_camera) {
    EXPECT_LT(p.z(), 2.0);
  }
}

TEST_P(FeaturesOf, PlainImagesHaveNone) {
  camera::RgbdFrame frame = frameA();
  frame.gray = cv::Mat(frame.gray.size(), CV_8UC1, cv::Scalar(100));
  EXPECT_EQ(extractFeatures(frame, kCamera, config()).size(), 0);
}

TEST_P(FeaturesOf, AreNeverMoreThanAskedFor) {
  for (const int count : {1, 10, 47, 48, 100}) {
    FeatureConfig few = config();
    few.count = count;
    EXPECT_LE(extractFeatures(frameA(), kCamera, few).size(), count);
  }
}

TEST_P(FeaturesOf, AreDeterministic) {
  const Features a = extractFeatures(frameA(), kCamera, config());
  const Features b = extractFeatures(frameA(), kCamera, config());
  EXPECT_EQ(a.pixel, b.pixel);
  EXPECT_EQ(a.descriptor, b.descriptor);
}

INSTANTIATE_TEST_SUITE_P(Both, FeaturesOf, ::testing::Values(FeatureType::kSift, FeatureType::kOrb),
                         [](const auto& type) { return std::string(base::toString(type.param)); });

}  // namespace
}  // namespace oikos::mapping
