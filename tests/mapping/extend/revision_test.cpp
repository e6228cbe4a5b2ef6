// SPDX-License-Identifier: Apache-2.0
// A room with exact depth, as it was and as it is.
#include "mapping/extend/revision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/geometry/se3.h"
#include "tests/support/analytic_room.h"
#include "tests/support/config_rules_check.h"

namespace oikos::mapping {
namespace {

constexpr int kEarlier = 32;
const test::AnalyticBox kWalls = {{-2.5, -2.5, 0.0}, {2.5, 2.5, 2.5}, {200, 200, 200}};
const test::AnalyticBox kTable = {{1.5, -0.7, 0.0}, {2.4, 0.7, 0.7}, {220, 30, 30}};
const test::AnalyticBox kChest = {{-2.2, -0.5, 0.0}, {-1.5, 0.3, 0.8}, {30, 30, 220}};
const test::AnalyticBox kMovedChest = {{-0.3, -2.1, 0.0}, {0.4, -1.3, 0.8}, {30, 30, 220}};

camera::PinholeCamera roomCamera() {
  return {320, 240, 277.0, 277.0, 159.5, 119.5};
}

std::vector<Eigen::Isometry3d> ringPoses(int count) {
  std::vector<Eigen::Isometry3d> poses = test::lookAround(count / 2, 0.8, 1.9, 0.65);
  const std::vector<Eigen::Isometry3d> across = test::lookAround(count / 2, -0.7, 1.8, 0.45);
  poses.insert(poses.end(), across.begin(), across.end());
  return poses;
}

/// Frames from kEarlier on are of the room as it is now.
struct TwoDrives {
  std::vector<test::AnalyticBox> before;
  std::vector<test::AnalyticBox> now;
  std::vector<Eigen::Isometry3d> poses_before = ringPoses(kEarlier);
  std::vector<Eigen::Isometry3d> poses_now = ringPoses(20);

  [[nodiscard]] Revision revise(int threads = 1, const RevisionConfig& config = {}, const std::vector<int>& kept = {}) const {
    const camera::PinholeCamera camera = roomCamera();
    const auto read = [&](int frame, bool) {
      const bool is_now = frame >= kEarlier;
      camera::RgbdFrame image = test::AnalyticRoom(kWalls, is_now ? now : before)
                                    .render(camera, is_now ? poses_now[static_cast<std::size_t>(frame - kEarlier)]
                                                           : poses_before[static_cast<std::size_t>(frame)]);
      image.index = frame;
      return image;
    };
    std::vector<View> earlier;
    for (std::size_t i = 0; i < poses_before.size(); ++i) {
      earlier.push_back({static_cast<int>(i), poses_before[i]});
    }
    std::vector<DriveView> drive;
    for (std::size_t i = 0; i < poses_now.size(); ++i) {
      const int frame = kEarlier + static_cast<int>(i);
      drive.push_back({{frame, poses_now[i]}, std::find(kept.begin(), kept.end(), frame) != kept.end()});
    }
    OccupancyConfig occupancy;
    occupancy.pixel_stride = 1;
    return mapping::revise(earlier, drive, {camera, read, threads, {}}, occupancy, config);
  }
};

TEST(Revision, OfAnUnchangedRoomIsNothing) {
  const TwoDrives drives{{kTable, kChest}, {kTable, kChest}};
  const Revision revision = drives.revise();
  EXPECT_EQ(revision.changes.status, ChangeStatus::kCompared);
  EXPECT_TRUE(revision.changes.changes.empty());
  EXPECT_TRUE(revision.gone.empty());
  EXPECT_TRUE(revision.witnesses.empty());
}

TEST(Revision, AMovedChestHasGoneHereAndIsNewThere) {
  const TwoDrives drives{{kTable, kChest}, {kTable, kMovedChest}};
  const Revision revision = drives.revise();
  ASSERT_EQ(revision.changes.changes.size(), 2U);
  EXPECT_TRUE(revision.gone.contains({-1.51, -0.1, 0.4}));    // its front
  EXPECT_FALSE(revision.gone.contains({-0.29, -1.7, 0.4}));   // where it is now
  EXPECT_FALSE(revision.gone.contains({1.51, 0.0, 0.4}));     // the table
  EXPECT_FALSE(revision.gone.contains({-1.9, -0.1, -0.01}));  // the floor under it
  ASSERT_FALSE(revision.witnesses.empty());
  EXPECT_LE(revision.witnesses.size(), 12U);  // of 20 views
  EXPECT_TRUE(std::is_sorted(revision.witnesses.begin(), revision.witnesses.end()));
  for (const int witness : revision.witnesses) {
    EXPECT_GE(witness, kEarlier);
  }
}

TEST(Revision, WhatKeyframesShowNeedsNoMoreWitnesses) {
  const TwoDrives drives{{kTable, kChest}, {kTable, kMovedChest}};
  const Revision revision = drives.revise();
  EXPECT_TRUE(drives.revise(1, {}, revision.witnesses).witnesses.empty());
  RevisionConfig one;
  one.witnesses = 1;
  EXPECT_LT(drives.revise(1, one).witnesses.size(), revision.witnesses.size());
}

TEST(Revision, TheSameForAnyNumberOfThreads) {
  const TwoDrives drives{{kTable, kChest}, {kTable, kMovedChest}};
  const Revision one = drives.revise(1);
  const Revision three = drives.revise(3);
  EXPECT_EQ(one.witnesses, three.witnesses);
  ASSERT_EQ(one.changes.changes.size(), three.changes.changes.size());
  for (std::size_t i = 0; i < one.changes.changes.size(); ++i) {
    EXPECT_EQ(one.changes.changes[i].voxels, three.changes.changes[i].voxels);
    EXPECT_EQ(one.changes.changes[i].confidence, three.changes.changes[i].confidence);
  }
}

TEST(Revision, AMapOfNothingIsComparedWithNothing) {
  TwoDrives drives{{}, {kTable}};
  drives.poses_before.clear();
  const Revision revision = drives.revise();
  EXPECT_EQ(revision.changes.status, ChangeStatus::kNotInMap);
  EXPECT_TRUE(revision.witnesses.empty());
}

TEST(SpreadOut, TakesAViewAStepAndAllThatAreKept) {
  std::vector<DriveView> drive;
  for (int i = 0; i < 21; ++i) {
    drive.push_back({{i, Eigen::Isometry3d(Eigen::Translation3d(0.05 * i, 0.0, 1.0))}, i == 7});
  }
  for (int i = 1; i <= 4; ++i) {  // turns on the spot
    drive.push_back({{20 + i, drive[20].view.T_a_camera * Eigen::AngleAxisd(0.12 * i, Eigen::Vector3d::UnitY())}, false});
  }
  RevisionConfig config;
  config.view_step_m = 0.2499;
  std::vector<int> frames;
  for (const DriveView& view : spreadOut(drive, config)) {
    frames.push_back(view.view.frame);
  }
  EXPECT_EQ(frames, (std::vector<int>{0, 5, 7, 12, 17, 22, 24}));
  EXPECT_TRUE(spreadOut({}, config).empty());
}

TEST(RevisionConfig, RulesAreChecked) {
  test::checkConfigRules<RevisionConfig>({{"view_step_m", "0", "must be > 0"},
                                          {"view_step_deg", "0", "must be > 0 and <= 180"},
                                          {"pose_sigma_m", "-1", "must be >= 0"},
                                          {"pose_sigma_deg", "nan", "must be >= 0"},
                                          {"known_share", "1.5", "must be from 0 to 1"},
                                          {"like_view_deg", "0", "must be > 0 and <= 180"},
                                          {"witnesses", "0", "must be >= 1"},
                                          {"min_gain_voxels", "0", "must be >= 1"}});
}

}  // namespace
}  // namespace oikos::mapping
