// SPDX-License-Identifier: Apache-2.0
#include "mapping/relocalise/relocaliser.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/geometry/se3.h"
#include "mapping/graph/keyframe_reader.h"
#include "mapping/relocalise/map_tracker.h"
#include "tests/mapping/graph/synthetic_drive.h"
#include "tests/mapping/relocalise/saved_room.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

void expectNear(const LocateResult& found, const Eigen::Isometry3d& T_map_camera, int frame) {
  const geometry::Vector6d xi = geometry::logSe3(found.T_map_camera.inverse() * T_map_camera);
  EXPECT_LT(xi.head<3>().norm(), 0.02) << "frame " << frame;
  EXPECT_LT(xi.tail<3>().norm(), 0.01) << "frame " << frame;
  EXPECT_LT(xi.dot(found.covariance.ldlt().solve(xi)), 22.5) << "frame " << frame;  // chi squared, 6 degrees of freedom, one in a thousand
}

LocateResult find(const Relocaliser& relocaliser, const camera::RgbdFrame& frame) {
  return relocaliser.find({frame, ImagePyramid(frame.gray, relocaliser.config().pyramid_levels)});
}

TEST(SavedMap, HoldsWhatWasSaved) {
  const SavedMap map(savedRoom().file());
  const KeyframeStore store = readKeyframeStore(savedRoom().file());
  ASSERT_EQ(map.keyframeCount(), savedRoom().keyframes);
  ASSERT_EQ(store.keyframes.size(), static_cast<std::size_t>(map.keyframeCount()));
  std::size_t landmarks = 0;
  for (int node = 0; node < map.keyframeCount(); ++node) {
    const StoredKeyframe& stored = store.keyframes[static_cast<std::size_t>(node)];
    const Node& held = map.graph().nodes[static_cast<std::size_t>(node)];
    EXPECT_EQ(held.frame, stored.frame);
    EXPECT_EQ(held.T_world_camera.matrix(), stored.T_map_camera.matrix());
    EXPECT_EQ(map.features(node).size(), stored.features.size());
    landmarks += stored.landmarks.size();
    for (const int id : held.hosted) {
      EXPECT_EQ(map.graph().landmarks[static_cast<std::size_t>(id)].host, node);
    }
    EXPECT_EQ(map.pyramid(node)->level(0).size(), stored.color.size());
    EXPECT_EQ(map.places().query(map.features(node), 1).front().place, node);
  }
  EXPECT_EQ(map.graph().landmarks.size(), landmarks);
}

TEST(SavedMap, WithoutKeyframesIsAnError) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "keyframes.sqlite";
  KeyframeStoreWriter writer(file, test::texturedCamera());
  writer.commit();
  test::expectError(base::ErrorCode::kInput, {file.string(), "no keyframe"}, [&] { const SavedMap map(file); });
}

/// Frames between the mapped ones, turned and moved away from them, each without a prior.
TEST(Relocaliser, FindsFramesOnTheirOwn) {
  const SavedMap map(savedRoom().file());
  const Relocaliser relocaliser(map, {}, 7);
  std::vector<Eigen::Isometry3d> poses = turnAround(11.0, 171.0, 8);
  geometry::Vector6d away;
  away << 0.1, -0.05, 0.15, 0.05, 0.1, -0.1;
  for (Eigen::Isometry3d& T_map_camera : poses) {
    T_map_camera = T_map_camera * geometry::expSe3(away);
  }
  const auto asked = recordingOf(poses, {}, 2);
  for (int i = 0; i < asked.frameCount(); ++i) {
    const LocateResult found = find(relocaliser, asked.read(i, recording::Channels::kGray));
    ASSERT_EQ(found.status, LocateStatus::kRelocalised) << i;
    EXPECT_GE(found.inliers, 25);
    EXPECT_GE(found.landmarks, found.inliers);
    EXPECT_GE(found.keyframe, 0);
    expectNear(found, asked.truth()[static_cast<std::size_t>(i)].T_map_camera, i);
  }
}

TEST(Relocaliser, UnknownGroundIsNotFound) {
  const SavedMap map(savedRoom().file());
  const Relocaliser relocaliser(map, {}, 7);
  const auto unknown = recordingOf(turnAround(250.0, 300.0, 3), {2}, 2);
  for (int i = 0; i < unknown.frameCount(); ++i) {
    EXPECT_FALSE(find(relocaliser, unknown.read(i, recording::Channels::kGray)).found()) << i;
  }
  EXPECT_EQ(find(relocaliser, unknown.read(2, recording::Channels::kGray)).status, LocateStatus::kNoPlace);  // a covered lens
}

TEST(Relocaliser, FromAPoseNearbyNoFeaturesAreNeeded) {
  const SavedMap map(savedRoom().file());
  const Relocaliser relocaliser(map, {}, 7);
  const auto asked = recordingOf(turnAround(50.0, 54.0, 1), {}, 2);
  const camera::RgbdFrame frame = asked.read(0, recording::Channels::kGray);
  const Eigen::Isometry3d T_map_camera = asked.truth()[0].T_map_camera;
  const ImagePyramid pyramid(frame.gray, relocaliser.config().pyramid_levels);
  geometry::Vector6d off;
  off << 0.02, 0.01, -0.02, 0.004, -0.006, 0.004;
  const LocateResult near = relocaliser.findNear({frame, pyramid}, T_map_camera * geometry::expSe3(off));
  ASSERT_EQ(near.status, LocateStatus::kTracked);
  expectNear(near, T_map_camera, 0);
  const Eigen::Isometry3d T_map_behind = T_map_camera * Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitY());
  EXPECT_FALSE(relocaliser.findNear({frame, pyramid}, T_map_behind).found());
}

TEST(Relocaliser, TheSameAnswerTwice) {
  const SavedMap map(savedRoom().file());
  const auto asked = recordingOf(turnAround(77.0, 80.0, 1), {}, 2);
  const camera::RgbdFrame frame = asked.read(0, recording::Channels::kGray);
  const LocateResult once = find(Relocaliser(map, {}, 7), frame);
  const LocateResult twice = find(Relocaliser(map, {}, 7), frame);
  EXPECT_EQ(once.T_map_camera.matrix(), twice.T_map_camera.matrix());
  EXPECT_EQ(once.covariance, twice.covariance);
}

/// Tracked through the map, lost behind a covered lens, found again; lost for good where the map ends.
TEST(MapTracker, FollowsLosesAndFindsAgain) {
  const SavedMap map(savedRoom().file());
  const Relocaliser relocaliser(map, {}, 7);
  std::vector<Eigen::Isometry3d> drive = turnAround(20.0, 120.0, 40);
  append(drive, turnAround(260.0, 290.0, 4));
  const auto asked = recordingOf(drive, {10, 11}, 2);
  MapTracker tracker(relocaliser);
  for (int i = 0; i < asked.frameCount(); ++i) {
    const LocateResult result = tracker.add(asked.read(i, recording::Channels::kGray));
    if (i == 10 || i == 11 || i >= 40) {
      EXPECT_FALSE(result.found()) << i;
      continue;
    }
    ASSERT_EQ(result.status, i == 0 || i == 12 ? LocateStatus::kRelocalised : LocateStatus::kTracked) << i;
    expectNear(result, asked.truth()[static_cast<std::size_t>(i)].T_map_camera, i);
  }
}

TEST(MapTracker, APriorServesWhereFeaturesWouldBeNeeded) {
  const SavedMap map(savedRoom().file());
  RelocaliseConfig blind;
  blind.min_votes = 1'000'000;
  const Relocaliser relocaliser(map, blind, 7);
  const auto asked = recordingOf(turnAround(50.0, 54.0, 1), {}, 2);
  const camera::RgbdFrame frame = asked.read(0, recording::Channels::kGray);
  EXPECT_EQ(MapTracker(relocaliser).add(frame).status, LocateStatus::kNoPlace);
  MapTracker tracker(relocaliser);
  const LocateResult result = tracker.add(frame, asked.truth()[0].T_map_camera);
  ASSERT_EQ(result.status, LocateStatus::kTracked);
  expectNear(result, asked.truth()[0].T_map_camera, 0);
}

TEST(LocateStatus, HasNames) {
  test::checkEnumTable(LocateStatus::kTracked);
}

TEST(RelocaliseConfig, RulesAreChecked) {
  EXPECT_TRUE(base::validateConfig(RelocaliseConfig{}).empty());
  RelocaliseConfig config;
  config.candidates = 0;
  config.max_view_deg = 190.0;
  config.map_sigma_m = -1.0;
  EXPECT_EQ(config.validate(), (std::vector<std::string>{"candidates = 0: must be >= 1", "max_view_deg = 190: must be > 0 and <= 180",
                                                         "map_sigma_m = -1: must be >= 0"}));
}

}  // namespace
}  // namespace oikos::mapping
