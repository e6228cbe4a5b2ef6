// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/change_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "core/base/error.h"
#include "tests/support/analytic_room.h"
#include "tests/support/enum_table_check.h"

namespace oikos::mapping {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const test::AnalyticBox kWalls = {{-2.5, -2.5, 0.0}, {2.5, 2.5, 2.5}, {200, 200, 200}};
const test::AnalyticBox kTable = {{1.5, -0.7, 0.0}, {2.4, 0.7, 0.7}, {220, 30, 30}};
const test::AnalyticBox kChest = {{-2.2, -0.5, 0.0}, {-1.5, 0.3, 0.8}, {30, 30, 220}};
const test::AnalyticBox kMovedChest = {{-0.3, -2.1, 0.0}, {0.4, -1.3, 0.8}, {30, 30, 220}};
const test::AnalyticBox kParcel = {{1.7, 0.0, 0.7}, {2.1, 0.4, 1.1}, {200, 180, 90}};  ///< on the table

using Boxes = std::vector<test::AnalyticBox>;

/// Outwards from a ring, and across it.
std::vector<Eigen::Isometry3d> ringPoses(int count) {
  std::vector<Eigen::Isometry3d> poses = test::lookAround(count, 0.8, 1.9, 0.65);
  for (const Eigen::Isometry3d& T_map_camera : test::lookAround(count, -0.7, 1.8, 0.45)) {
    poses.push_back(T_map_camera);
  }
  return poses;
}

SeenSpace mapOf(const Boxes& furniture, const std::vector<Eigen::Isometry3d>& poses = ringPoses(16)) {
  const test::AnalyticRoom room(kWalls, furniture);
  OccupancyConfig config;
  config.pixel_stride = 1;
  SeenSpace map(config, {}, 1);
  for (const Eigen::Isometry3d& T_map_camera : poses) {
    const camera::RgbdFrame frame = room.render(test::smallCamera(), T_map_camera);
    map.insert({frame, test::smallCamera(), T_map_camera});
  }
  return map;
}

LocatedScan scanOf(const Boxes& furniture, const Eigen::Isometry3d& T_map_camera) {
  return {test::AnalyticRoom(kWalls, furniture).render(test::smallCamera(), T_map_camera).depth_m, test::smallCamera(), T_map_camera,
          geometry::Matrix6d::Zero()};
}

std::vector<LocatedScan> scansOf(const Boxes& furniture) {
  std::vector<LocatedScan> scans;
  for (const Eigen::Isometry3d& T_map_camera : ringPoses(10)) {
    scans.push_back(scanOf(furniture, T_map_camera));
  }
  return scans;
}

/// For an image of few pixels.
ChangeConfig fineConfig() {
  ChangeConfig config;
  config.pixel_stride = 1;
  config.min_points = 1;
  config.surface.edge_px = 1;
  config.surface.max_step_ratio = 0.05;
  config.surface.max_depth_m = 4.5;
  return config;
}

/// Seen sides lie within a voxel and the part of the tolerance that is not claimed.
void expectBox(const Change& change, const test::AnalyticBox& truth) {
  const Eigen::Vector3d low = change.center_map - 0.5 * change.size_m;
  const Eigen::Vector3d high = change.center_map + 0.5 * change.size_m;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(low[axis], truth.min_map[axis], 0.1) << "axis " << axis;
    EXPECT_NEAR(high[axis], truth.max_map[axis], 0.1) << "axis " << axis;
  }
  ASSERT_TRUE(change.support_height_m);
  EXPECT_NEAR(*change.support_height_m, truth.min_map.z(), 0.05);
  EXPECT_GT(change.confidence, 0.9);
  EXPECT_LE(change.confidence, 1.0);
}

TEST(ChangeFinder, FindsWhatWasAdded) {
  const ChangeResult result = findChanges(mapOf({kTable}), scansOf({kTable, kChest}), fineConfig());
  EXPECT_EQ(result.status, ChangeStatus::kCompared);
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_EQ(result.changes[0].kind, ChangeKind::kNew);
  expectBox(result.changes[0], kChest);
}

TEST(ChangeFinder, FindsWhatWasPutOnATable) {
  const ChangeResult result = findChanges(mapOf({kTable}), scansOf({kTable, kParcel}), fineConfig());
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_EQ(result.changes[0].kind, ChangeKind::kNew);
  expectBox(result.changes[0], kParcel);
}

TEST(ChangeFinder, FindsWhatWasRemoved) {
  const ChangeResult result = findChanges(mapOf({kTable, kChest}), scansOf({kTable}), fineConfig());
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_EQ(result.changes[0].kind, ChangeKind::kGone);
  expectBox(result.changes[0], kChest);
}

TEST(ChangeFinder, FindsWhatWasMoved) {
  const ChangeResult result = findChanges(mapOf({kTable, kChest}), scansOf({kTable, kMovedChest}), fineConfig());
  ASSERT_EQ(result.changes.size(), 2U);
  EXPECT_EQ(result.changes[0].kind, ChangeKind::kNew);
  expectBox(result.changes[0], kMovedChest);
  EXPECT_EQ(result.changes[1].kind, ChangeKind::kGone);
  expectBox(result.changes[1], kChest);
}

TEST(ChangeFinder, OneScanIsEnough) {
  const Eigen::Isometry3d T_map_camera = test::lookAt({0.8, 0.3, 1.4}, {-1.8, -0.1, 0.4});
  const SeenSpace map = mapOf({kTable});
  const ChangeResult result = findChanges(map, {scanOf({kTable, kChest}, T_map_camera)}, fineConfig());
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_EQ(result.changes[0].kind, ChangeKind::kNew);
}

TEST(ChangeFinder, NothingChangedIsNoChange) {
  const ChangeResult result = findChanges(mapOf({kTable, kChest}), scansOf({kTable, kChest}), fineConfig());
  EXPECT_EQ(result.status, ChangeStatus::kCompared);
  EXPECT_TRUE(result.changes.empty());
}

/// Off by exactly 2 cm and 1° in random directions, readings noisy by 2 mm·z², one in twenty missing.
TEST(ChangeFinder, AMovedCameraAndNoiseAreNoChange) {
  const SeenSpace map = mapOf({kTable, kChest});
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized(); };
  std::size_t boxes_of_overconfident = 0;
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<LocatedScan> scans = scansOf({kTable, kChest});
    for (LocatedScan& scan : scans) {
      for (float& z : cv::Mat_<float>(scan.depth_m)) {
        z = random() % 20 == 0 ? std::numeric_limits<float>::quiet_NaN() : z + static_cast<float>(0.002 * z * z * normal(random));
      }
      const Eigen::Vector3d shift = 0.02 * direction();
      scan.T_map_camera = scan.T_map_camera * Eigen::Translation3d(shift) * Eigen::AngleAxisd(1.0 * kDegree, direction());
      scan.covariance.diagonal().head<3>().setConstant(0.02 * 0.02 / 3.0);
      scan.covariance.diagonal().tail<3>().setConstant(kDegree * kDegree / 3.0);
    }
    const ChangeResult result = findChanges(map, scans, fineConfig());
    EXPECT_EQ(result.status, ChangeStatus::kCompared);
    EXPECT_TRUE(result.changes.empty()) << "trial " << trial;
    for (LocatedScan& scan : scans) {
      scan.covariance.setZero();
      boxes_of_overconfident += findChanges(map, {scan}, fineConfig()).changes.size();
    }
  }
  EXPECT_GT(boxes_of_overconfident, 0U);  // it is the stated uncertainty that keeps them away
}

TEST(ChangeFinder, MissingDepthIsNoChange) {
  std::vector<LocatedScan> scans = scansOf({kTable});  // the chest is gone, but no scan has readings there
  for (LocatedScan& scan : scans) {
    const LocatedScan before = scanOf({kTable, kChest}, scan.T_map_camera);
    cv::Mat hidden;
    cv::dilate(before.depth_m < scan.depth_m - 1e-4F, hidden, cv::Mat(), cv::Point(-1, -1), 6);
    scan.depth_m.setTo(std::numeric_limits<float>::quiet_NaN(), hidden);
  }
  EXPECT_TRUE(findChanges(mapOf({kTable, kChest}), scans, fineConfig()).changes.empty());
}

/// A floor lamp's pole, about which all scans look at the wall behind: a depth camera has no readings of things so thin from some places.
TEST(ChangeFinder, APoleThatGivesNoReadingsIsNotGone) {
  const test::AnalyticBox pole = {{0.975, 0.975, 0.0}, {1.025, 1.025, 1.5}, {30, 30, 30}};
  const SeenSpace map = mapOf({kTable, pole});
  std::vector<LocatedScan> unread = scansOf({kTable});
  for (LocatedScan& scan : unread) {
    const LocatedScan before = scanOf({kTable, pole}, scan.T_map_camera);
    scan.depth_m.setTo(std::numeric_limits<float>::quiet_NaN(), before.depth_m < scan.depth_m - 1e-4F);
  }
  EXPECT_TRUE(findChanges(map, unread, fineConfig()).changes.empty());
  const ChangeResult taken = findChanges(map, scansOf({kTable}), fineConfig());
  ASSERT_EQ(taken.changes.size(), 1U);
  EXPECT_EQ(taken.changes[0].kind, ChangeKind::kGone);
}

/// The map was seen towards +x only; the chest stands at its border and beyond.
TEST(ChangeFinder, WhatTheMapNeverSawIsNoChange) {
  std::vector<Eigen::Isometry3d> poses;
  for (const Eigen::Isometry3d& T_map_camera : ringPoses(16)) {
    if (T_map_camera.linear()(0, 2) > 0.5) {
      poses.push_back(T_map_camera);
    }
  }
  const ChangeResult result = findChanges(mapOf({kTable}, poses), scansOf({kTable, kChest, kMovedChest}), fineConfig());
  EXPECT_EQ(result.status, ChangeStatus::kCompared);
  EXPECT_TRUE(result.changes.empty());
}

TEST(ChangeFinder, WhatMostScansSeeThroughIsNoChange) {
  std::vector<LocatedScan> scans = scansOf({kTable});
  scans[5] = scanOf({kTable, kChest}, scans[5].T_map_camera);  // somebody walked through one image
  EXPECT_EQ(findChanges(mapOf({kTable}), {scans[5]}, fineConfig()).changes.size(), 1U);
  EXPECT_TRUE(findChanges(mapOf({kTable}), scans, fineConfig()).changes.empty());
}

TEST(ChangeFinder, WhatMostScansStillSeeIsNotGone) {
  const SeenSpace map = mapOf({kTable, kChest});
  std::vector<LocatedScan> scans = scansOf({kTable, kChest});
  scans[5] = scanOf({kTable}, scans[5].T_map_camera);
  const ChangeResult alone = findChanges(map, {scans[5]}, fineConfig());
  ASSERT_EQ(alone.changes.size(), 1U);
  EXPECT_EQ(alone.changes[0].kind, ChangeKind::kGone);
  EXPECT_TRUE(findChanges(map, scans, fineConfig()).changes.empty());
}

TEST(ChangeFinder, SpecksAndSliversAreNoChange) {
  const SeenSpace map = mapOf({kTable});
  const std::vector<LocatedScan> scans = scansOf({kTable, kChest});
  ChangeConfig config = fineConfig();
  config.min_seed_voxels = 1000;
  EXPECT_TRUE(findChanges(map, scans, config).changes.empty());
  config = fineConfig();
  config.min_size_m = 1.0;
  EXPECT_TRUE(findChanges(map, scans, config).changes.empty());
}

TEST(ChangeFinder, AScanElsewhereThanItSaysIsMisplaced) {
  LocatedScan scan = scanOf({}, test::lookAt({0.0, 0.0, 1.3}, {2.5, 0.0, 1.3}));
  scan.T_map_camera.translation().x() -= 0.7;
  const SeenSpace map = mapOf({});
  const ChangeResult nearer = findChanges(map, {scan}, fineConfig());  // the wall hangs in free space
  EXPECT_EQ(nearer.status, ChangeStatus::kMisplaced);
  EXPECT_TRUE(nearer.changes.empty());
  scan.T_map_camera.translation().x() += 1.4;
  EXPECT_NE(findChanges(map, {scan}, fineConfig()).status, ChangeStatus::kCompared);  // the wall is seen through
}

TEST(ChangeFinder, AScanOfAnotherPlaceIsNotInTheMap) {
  std::vector<LocatedScan> scans = {scanOf({}, test::lookAt({0.0, 0.0, 1.3}, {2.5, 0.0, 1.0}))};
  scans[0].T_map_camera.translation().x() += 20.0;
  const ChangeResult result = findChanges(mapOf({}), scans, fineConfig());
  EXPECT_EQ(result.status, ChangeStatus::kNotInMap);
  EXPECT_EQ(result.scans, std::vector<ChangeStatus>{ChangeStatus::kNotInMap});
  EXPECT_TRUE(result.changes.empty());
}

TEST(ChangeFinder, WithoutReadingsOrWithAPoseTooUncertainThereIsNoSurface) {
  const SeenSpace map = mapOf({});
  EXPECT_EQ(findChanges(map, {}, fineConfig()).status, ChangeStatus::kNoSurface);
  LocatedScan scan = scanOf({}, test::lookAt({0.0, 0.0, 1.3}, {2.5, 0.0, 1.0}));
  scan.covariance.diagonal().head<3>().setConstant(0.3 * 0.3);
  EXPECT_EQ(findChanges(map, {scan}, fineConfig()).status, ChangeStatus::kNoSurface);
  scan.covariance.setZero();
  scan.depth_m.setTo(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(findChanges(map, {scan}, fineConfig()).status, ChangeStatus::kNoSurface);
}

TEST(ChangeFinder, TheSameForAnyNumberOfThreads) {
  const SeenSpace map = mapOf({kTable, kChest});
  const std::vector<LocatedScan> scans = scansOf({kTable, kMovedChest, kParcel});
  ChangeConfig config = fineConfig();
  const ChangeResult serial = findChanges(map, scans, config);
  config.threads = 4;
  const ChangeResult parallel = findChanges(map, scans, config);
  ASSERT_EQ(serial.changes.size(), 3U);
  ASSERT_EQ(parallel.changes.size(), serial.changes.size());
  for (std::size_t i = 0; i < serial.changes.size(); ++i) {
    EXPECT_EQ(parallel.changes[i].center_map, serial.changes[i].center_map);
    EXPECT_EQ(parallel.changes[i].size_m, serial.changes[i].size_m);
    EXPECT_EQ(parallel.changes[i].support_height_m, serial.changes[i].support_height_m);
    EXPECT_EQ(parallel.changes[i].confidence, serial.changes[i].confidence);
    EXPECT_EQ(parallel.changes[i].voxels, serial.changes[i].voxels);
  }
}

TEST(ChangeFinder, RefusesABrokenConfiguration) {
  ChangeConfig config;
  config.surface.edge_px = 0;
  EXPECT_THROW((void)findChanges(mapOf({}, {}), {}, config), base::ContractViolation);
}

TEST(ChangeFinder, NamesRoundTrip) {
  test::checkEnumTable(ChangeKind::kGone);
  test::checkEnumTable(ChangeStatus::kCompared);
}

}  // namespace
}  // namespace oikos::mapping
