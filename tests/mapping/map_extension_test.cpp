// SPDX-License-Identifier: Apache-2.0
// Maps of the furnished room that are extended by a second drive; the truth of both drives is known in the room's frame.
#include "mapping/map_extension.h"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/geometry/se3.h"
#include "mapping/relocalise/saved_map.h"
#include "tests/mapping/built_map.h"
#include "tests/support/expect_error.h"

namespace oikos::mapping {
namespace {

RichRecording secondDrive(const std::vector<Eigen::Isometry3d>& drive) {
  test::SyntheticSensor sensor = noisySensor();
  sensor.seed = 7;
  return richRecording(drive, sensor);
}

MapRun extending(const Built& map, int threads = 1) {
  MapRun run{.threads = threads};
  run.extended = map.folder.path();
  return run;
}

nlohmann::json reportOf(const Built& built) {
  return nlohmann::json::parse(base::readFile(built.folder.path() / "report.json"));
}

/// Greatest distance of a pose from the truth, both seen from the first frame of the first drive.
double worstError_m(const recording::Trajectory& poses, const std::vector<Eigen::Isometry3d>& truth) {
  EXPECT_EQ(poses.size(), truth.size());
  double worst_m = 0.0;
  for (std::size_t i = 0; i < std::min(poses.size(), truth.size()); ++i) {
    const Eigen::Isometry3d T_first_now = poses.front().T_map_camera.inverse() * poses[i].T_map_camera;
    worst_m = std::max(worst_m, distance_m(T_first_now, truth.front().inverse() * truth[i]));
  }
  return worst_m;
}

std::vector<Eigen::Isometry3d> joined(std::vector<Eigen::Isometry3d> first, const std::vector<Eigen::Isometry3d>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// The fewest landmarks that a frame of the drive was placed by, from the `first` on.
int leastInliers(const Built& built, std::size_t first) {
  const auto rows = reportOf(built)["frames"]["rows"];
  int least = std::numeric_limits<int>::max();
  for (std::size_t i = first; i < rows.size(); ++i) {
    least = std::min(least, rows[i][2].get<int>());
  }
  return least;
}

TEST(MapExtension, ASecondDriveJoinsTheMapInItsFrame) {
  const std::vector<Eigen::Isometry3d> first = shortDrive(50, -20.0, 90.0);
  const std::vector<Eigen::Isometry3d> second = shortDrive(60, 20.0, 130.0);  // half of it where the map has been
  const Built map(richRecording(first));
  const Built both(secondDrive(second), extending(map));
  ASSERT_TRUE(both.result.is_placed);
  EXPECT_EQ(both.result.frames, 60);
  EXPECT_EQ(both.result.earlier_keyframes, map.result.keyframes);
  EXPECT_GT(both.result.keyframes, map.result.keyframes);
  EXPECT_EQ(both.result.submaps, 1);
  EXPECT_TRUE(both.result.floor_found);
  const recording::Trajectory poses = both.trajectory();
  EXPECT_LT(worstError_m(poses, joined(first, second)), 0.03);
  // The map's frame stands.
  EXPECT_LT(distance_m(poses.front().T_map_camera, map.trajectory().front().T_map_camera), 0.01);
  EXPECT_LT(turn_rad(poses.front().T_map_camera, map.trajectory().front().T_map_camera), 0.005);
  const SavedMap saved(both.folder.path() / "keyframes.sqlite");
  EXPECT_EQ(saved.keyframeCount(), both.result.keyframes);
}

TEST(MapExtension, StampsGoOnWhereTheClockBeginsAgain) {
  const std::vector<Eigen::Isometry3d> drive = shortDrive(40, -20.0, 60.0);
  const Built map(richRecording(drive));
  const Built both(secondDrive(drive), extending(map));
  const recording::Trajectory poses = both.trajectory();
  ASSERT_EQ(poses.size(), 80U);
  const auto drives = reportOf(both)["drives"];
  ASSERT_EQ(drives.size(), 2U);
  EXPECT_EQ(drives[0], (nlohmann::json{{"first_frame", 0}, {"frames", 40}, {"added_to_stamps_s", 0}}));
  EXPECT_EQ(drives[1], (nlohmann::json{{"first_frame", 40}, {"frames", 40}, {"added_to_stamps_s", 2}}));
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(poses[40 + i].stamp_ns, poses[i].stamp_ns + 2'000'000'000);
  }
}

TEST(MapExtension, TheSameWayAgainAddsHardlyAKeyframe) {
  const std::vector<Eigen::Isometry3d> drive = shortDrive(120, -20.0, 300.0);
  const Built map(richRecording(drive));
  const Built both(secondDrive(drive), extending(map));
  ASSERT_TRUE(both.result.is_placed);
  EXPECT_LE(both.result.keyframes - map.result.keyframes, std::max(4, map.result.keyframes / 4)) << map.result.keyframes << " before";
  EXPECT_TRUE(both.result.changes.empty());
  // Landmarks that come into view are taken, though no keyframe is set; as soon as the drive has its place.
  constexpr std::size_t kPlaced = 60;
  EXPECT_GE(leastInliers(both, kPlaced), leastInliers(map, kPlaced));
  // What is seen again is placed as well as it was at first.
  EXPECT_LT(worstError_m(both.trajectory(), joined(drive, drive)), 1.5 * worstError_m(map.trajectory(), drive) + 0.002);
}

TEST(MapExtension, AnExtendedMapIsExtendedAgain) {
  const std::vector<Eigen::Isometry3d> first = shortDrive(40, -20.0, 60.0);
  const std::vector<Eigen::Isometry3d> second = shortDrive(50, 0.0, 100.0);
  const std::vector<Eigen::Isometry3d> third = shortDrive(50, 60.0, 100.0);
  const Built map(richRecording(first));
  const Built two(secondDrive(second), extending(map));
  const Built three(secondDrive(third), extending(two));
  ASSERT_TRUE(three.result.is_placed);
  EXPECT_LT(worstError_m(three.trajectory(), joined(joined(first, second), third)), 0.04);
  EXPECT_EQ(reportOf(three)["drives"].size(), 3U);
  EXPECT_EQ(three.result.earlier_keyframes, two.result.keyframes);
}

TEST(MapExtension, WithEveryFrameInTheVolumeTheEarlierKeyframesStay) {
  const Built map(richRecording(shortDrive(40, -20.0, 60.0)));
  MapConfig config;
  config.volume.every_frame = true;
  const Built both(secondDrive(shortDrive(30, 0.0, 45.0)), extending(map), config);
  const SavedMap saved(both.folder.path() / "keyframes.sqlite");
  EXPECT_EQ(saved.keyframeCount(), both.result.keyframes);
  EXPECT_GE(both.result.keyframes, map.result.keyframes);
}

TEST(MapExtension, SameBytesForAnyNumberOfThreads) {
  const Built map(richRecording(shortDrive(40, -20.0, 60.0)));
  const RichRecording second = secondDrive(shortDrive(40, 0.0, 80.0));
  const Built one(second, extending(map, 1));
  for (const int threads : {2, 3}) {
    SCOPED_TRACE(threads);
    expectSameButForTiming(one, Built(second, extending(map, threads)));
  }
}

TEST(MapExtension, ADriveElsewhereIsRefusedAndWritesNothing) {
  const Built map(richRecording(shortDrive(40, -20.0, 60.0)));
  const RichRecording elsewhere(test::TexturedWorld::furnished(99), test::texturedCamera(), shortDrive(40, -20.0, 60.0), noisySensor());
  const Built refused(elsewhere, extending(map));
  EXPECT_FALSE(refused.result.is_placed);
  EXPECT_TRUE(refused.files().empty());
  test::SyntheticSensor covered = noisySensor();
  for (int i = 0; i < 10; ++i) {
    covered.blank_frames.insert(i);
  }
  const Built dark(richRecording(shortDrive(10, -20.0, 60.0), covered), extending(map));
  EXPECT_FALSE(dark.result.is_placed);
}

TEST(MapExtension, MountsKeepTheBasesPath) {
  const std::vector<Eigen::Isometry3d> drive = shortDrive(40, -20.0, 60.0);
  const Built map(richRecording(drive), {.T_base_camera = trueMount()});
  MapRun run = extending(map);
  run.T_base_camera = trueMount();
  const Built both(secondDrive(drive), run);
  const recording::Trajectory camera = both.trajectory();
  const recording::Trajectory base = both.trajectory("base_trajectory.txt");
  ASSERT_EQ(base.size(), 80U);
  for (std::size_t i = 0; i < base.size(); ++i) {
    EXPECT_EQ(base[i].stamp_ns, camera[i].stamp_ns);
    EXPECT_LT(distance_m(base[i].T_map_camera * trueMount(), camera[i].T_map_camera), 1e-5) << i;
  }
}

// Past a table with a parcel on it.
const test::AnalyticBox kWalls = {{-2.0, -1.5, 0.0}, {2.0, 1.5, 2.5}, {200, 200, 200}};
const test::AnalyticBox kTable = {{0.6, -1.0, 0.0}, {1.4, 1.0, 0.75}, {220, 30, 30}};
const test::AnalyticBox kParcel = {{0.7, -0.6, 0.75}, {1.1, -0.15, 1.15}, {30, 30, 220}};
const test::AnalyticBox kMovedParcel = {{0.7, 0.25, 0.75}, {1.1, 0.7, 1.15}, {30, 30, 220}};

std::vector<Eigen::Isometry3d> pastTheTable(int frames) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < frames; ++i) {
    const double y_m = -1.1 + 2.2 * i / frames;
    poses.push_back(test::lookAt({-1.1, y_m, 1.5}, {1.0, 0.3 * y_m, 0.75}));
  }
  return poses;
}

RichRecording pastTable(std::vector<test::AnalyticBox> furniture, std::uint64_t seed) {
  test::SyntheticSensor sensor = noisySensor();
  sensor.seed = seed;
  return {test::TexturedWorld(test::AnalyticRoom(kWalls, std::move(furniture))), test::texturedCamera(), pastTheTable(80), sensor};
}

/// What the map says of the side of a box that the cameras see, over its middle; the first camera is where it truly was.
struct SeenSide {
  int occupied = 0;  ///< of 25 columns of voxels through the side
  int free = 0;      ///< likewise: none occupied, and the side's own voxel free
};
SeenSide sideOf(const Built& map, const test::AnalyticBox& box) {
  const std::unique_ptr<octomap::AbstractOcTree> file(octomap::AbstractOcTree::read((map.folder.path() / "octomap.ot").string()));
  const auto* tree = dynamic_cast<const octomap::OcTree*>(file.get());
  const Eigen::Isometry3d T_map_room = map.trajectory().front().T_map_camera * pastTheTable(80).front().inverse();
  const auto search = [&](const Eigen::Vector3d& point_room) {
    const Eigen::Vector3d p = T_map_room * point_room;
    return tree->search(p.x(), p.y(), p.z());
  };
  SeenSide side;
  for (int i = 0; i < 25; ++i) {
    const Eigen::Vector3d share(0.0, 0.2 + 0.15 * (i % 5), 0.35 + 0.12 * (i / 5));
    const Eigen::Vector3d point_room = box.min_map + share.cwiseProduct(box.max_map - box.min_map);
    bool is_occupied = false;
    for (const double along_m : {-0.03, 0.0, 0.03}) {
      const octomap::OcTreeNode* node = search(point_room + along_m * Eigen::Vector3d::UnitX());
      is_occupied = is_occupied || (node != nullptr && tree->isNodeOccupied(node));
    }
    const octomap::OcTreeNode* own = search(point_room);
    side.occupied += is_occupied ? 1 : 0;
    side.free += !is_occupied && own != nullptr && !tree->isNodeOccupied(own) ? 1 : 0;
  }
  return side;
}

TEST(MapExtension, WhatHasGoneIsForgottenAndWhatIsNewIsGained) {
  const Built map(pastTable({kTable, kParcel}, 1));
  ASSERT_GE(sideOf(map, kParcel).occupied, 24);
  ASSERT_GE(sideOf(map, kMovedParcel).free, 24);
  const Built both(pastTable({kTable, kMovedParcel}, 2), extending(map));
  ASSERT_TRUE(both.result.is_placed);
  EXPECT_GE(sideOf(both, kParcel).free, 24);
  EXPECT_GE(sideOf(both, kMovedParcel).occupied, 24);
  ASSERT_EQ(both.result.changes.size(), 2U);
  EXPECT_EQ(both.result.changes[0].kind, ChangeKind::kNew);
  EXPECT_EQ(both.result.changes[1].kind, ChangeKind::kGone);
  const auto changes = reportOf(both)["changes"];
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0]["kind"], "new");

  // It stays forgotten: the next drive sees no change, and the keyframes know of none.
  const Built again(pastTable({kTable, kMovedParcel}, 3), extending(both));
  EXPECT_TRUE(again.result.changes.empty());
  EXPECT_GE(sideOf(again, kParcel).free, 24);
  EXPECT_GE(sideOf(again, kMovedParcel).occupied, 24);
}

TEST(MapExtension, AnotherCameraOrKindOfFeatureIsRefused) {
  const Built map(richRecording(shortDrive(30, -20.0, 40.0)));
  camera::PinholeCamera other = test::texturedCamera();
  other.fx += 5.0;
  const RichRecording recording(test::TexturedWorld::furnished(), other, shortDrive(10, -20.0, 20.0), noisySensor());
  test::expectError(base::ErrorCode::kInput, {"keyframes.sqlite", "another camera"},
                    [&] { const Built refused(recording, extending(map)); });
  MapConfig config;
  config.front_end.features.type = FeatureType::kOrb;
  test::expectError(base::ErrorCode::kUsage, {"config.toml", "sift"},
                    [&] { const Built refused(secondDrive(shortDrive(10, -20.0, 20.0)), extending(map), config); });
  config = {};
  config.kind = FrontEndKind::kPairwise;
  test::expectError(base::ErrorCode::kUsage, {"pairwise"},
                    [&] { const Built refused(secondDrive(shortDrive(10, -20.0, 20.0)), extending(map), config); });
}

}  // namespace
}  // namespace oikos::mapping
