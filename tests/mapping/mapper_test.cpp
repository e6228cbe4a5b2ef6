// SPDX-License-Identifier: Apache-2.0
#include "mapping/mapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "tests/mapping/built_map.h"
#include "tests/support/expect_error.h"

namespace oikos::mapping {
namespace {

/// What the map's frame is without a mount: under the first camera, x along its optical axis.
Eigen::Isometry3d mapUnderFirstCamera(const Eigen::Isometry3d& T_room_camera) {
  const Eigen::Vector3d ahead = T_room_camera.linear().col(2);
  Eigen::Isometry3d T_room_map = Eigen::Isometry3d::Identity();
  T_room_map.linear() = Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_room_map.translation() = Eigen::Vector3d(T_room_camera.translation().x(), T_room_camera.translation().y(), 0.0);
  return T_room_map;
}

TEST(Mapper, WritesEveryFileOfAMap) {
  const Built built(richRecording(shortDrive(40, -20.0, 80.0)));
  std::set<std::string> names;
  for (const auto& [name, content] : built.files()) {
    names.insert(name);
    EXPECT_FALSE(content.empty()) << name;
  }
  const std::set<std::string> expected = {"cloud.ply",        "config.toml", "graph.g2o",     "grid.pgm",   "grid.yaml",
                                          "keyframes.sqlite", "mesh.ply",    "octomap.bt",    "octomap.ot", "report.html",
                                          "report.json",      "timing.json", "trajectory.txt"};
  EXPECT_EQ(names, expected);
  EXPECT_EQ(built.result.frames, 40);
  EXPECT_EQ(built.result.skipped_frames, 0);
  EXPECT_EQ(built.result.lost_frames, 0);
  EXPECT_EQ(built.result.submaps, 1);
  EXPECT_TRUE(built.result.floor_found);
  EXPECT_GE(built.result.keyframes, 2);
}

TEST(Mapper, TheMapIsUnderTheFirstCameraAndLooksWhereItLooks) {
  const RichRecording recording = richRecording(shortDrive(40, -20.0, 80.0));
  const Built built(recording);
  const recording::Trajectory truth = recording.truth();
  const Eigen::Isometry3d T_map_room = mapUnderFirstCamera(truth[0].T_map_camera).inverse();
  const recording::Trajectory poses = built.trajectory();
  ASSERT_EQ(poses.size(), truth.size());
  EXPECT_NEAR(poses[0].T_map_camera.translation().x(), 0.0, 0.005);
  EXPECT_NEAR(poses[0].T_map_camera.translation().y(), 0.0, 0.005);
  EXPECT_NEAR(poses[0].T_map_camera.translation().z(), 1.2, 0.03);  // the floor is z = 0
  EXPECT_NEAR(poses[0].T_map_camera.linear()(1, 2), 0.0, 0.005);    // x along the optical axis
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].stamp_ns, truth[i].stamp_ns);
    EXPECT_LT(distance_m(poses[i].T_map_camera, T_map_room * truth[i].T_map_camera), 0.03) << "frame " << i;
    EXPECT_LT(turn_rad(poses[i].T_map_camera, T_map_room * truth[i].T_map_camera), 0.015) << "frame " << i;
  }
}

TEST(Mapper, WithAMountTheMapIsTheBasesFirstPose) {
  const RichRecording recording = richRecording(shortDrive(40, -20.0, 80.0));
  const Built built(recording, {.T_base_camera = trueMount()});
  const recording::Trajectory base = built.trajectory("base_trajectory.txt");
  const recording::Trajectory camera = built.trajectory();
  const recording::Trajectory truth = recording.truth();
  ASSERT_EQ(base.size(), 40U);
  EXPECT_LT(distance_m(base[0].T_map_camera, Eigen::Isometry3d::Identity()), 0.03);  // but for the floor's own height and tilt
  EXPECT_NEAR(base[0].T_map_camera.translation().x(), 0.0, 1e-9);
  EXPECT_NEAR(base[0].T_map_camera.translation().y(), 0.0, 1e-9);
  EXPECT_NEAR(base[0].T_map_camera.linear()(1, 0), 0.0, 1e-9);
  EXPECT_LT(turn_rad(base[0].T_map_camera, Eigen::Isometry3d::Identity()), 0.015);
  for (std::size_t i = 0; i < base.size(); ++i) {
    EXPECT_LT(distance_m(base[i].T_map_camera * trueMount(), camera[i].T_map_camera), 1e-5);
    const Eigen::Isometry3d T_first_true = trueMount() * truth[0].T_map_camera.inverse() * truth[i].T_map_camera * trueMount().inverse();
    EXPECT_LT(distance_m(base[0].T_map_camera.inverse() * base[i].T_map_camera, T_first_true), 0.03);
  }
}

TEST(Mapper, TheRecordingsOwnMountDoesTheSame) {
  RichRecording recording = richRecording(shortDrive(20, -20.0, 40.0));
  const Built told(recording, {.T_base_camera = trueMount()});
  recording.mount = trueMount();
  const Built read(recording);
  ASSERT_TRUE(read.files().contains("base_trajectory.txt"));
  EXPECT_EQ(read.files().at("base_trajectory.txt"), told.files().at("base_trajectory.txt"));
  EXPECT_EQ(read.files().at("trajectory.txt"), told.files().at("trajectory.txt"));
  Eigen::Isometry3d other = trueMount();
  other.translation().x() += 0.5;
  recording.mount = other;
  const Built overruled(recording, {.T_base_camera = trueMount()});  // what the run says wins
  EXPECT_EQ(overruled.files().at("base_trajectory.txt"), told.files().at("base_trajectory.txt"));
}

TEST(Mapper, SameBytesForAnyNumberOfThreadsAndInEveryRun) {
  const RichRecording recording = richRecording(shortDrive(30, -20.0, 60.0));
  const Built one(recording, {.threads = 1});
  for (const int threads : {1, 2, 3}) {
    SCOPED_TRACE(threads);
    expectSameButForTiming(one, Built(recording, {.threads = threads}));
  }
}

TEST(Mapper, ARecordingInTheDarkIsAMapOfNothing) {
  test::SyntheticSensor sensor = noisySensor();
  for (int i = 0; i < 12; ++i) {
    sensor.blank_frames.insert(i);
  }
  const Built built(richRecording(shortDrive(12, 0.0, 20.0), sensor));
  EXPECT_EQ(built.result.frames, 12);
  EXPECT_EQ(built.result.lost_frames, 12);
  EXPECT_EQ(built.result.carried_frames, 0);
  EXPECT_FALSE(built.result.floor_found);
  EXPECT_EQ(built.trajectory().size(), 12U);
}

TEST(Mapper, AFirstFrameThatCannotBeReadIsSkippedAndCounted) {
  RichRecording recording = richRecording(shortDrive(20, -20.0, 40.0));
  recording.unreadable = {0};
  const Built built(recording);
  EXPECT_EQ(built.result.frames, 19);
  EXPECT_EQ(built.result.skipped_frames, 1);
  const recording::Trajectory poses = built.trajectory();
  ASSERT_EQ(poses.size(), 19U);
  EXPECT_EQ(poses[0].stamp_ns, recording.stampNs(1));
  EXPECT_NEAR(poses[0].T_map_camera.translation().x(), 0.0, 0.005);
}

TEST(Mapper, NoReadableFrameIsAnError) {
  RichRecording recording = richRecording(shortDrive(5, -20.0, 20.0));
  recording.unreadable = {0, 1, 2, 3, 4};
  test::expectError(base::ErrorCode::kInput, {}, [&] { const Built built(recording); });
}

/// A dark corridor in the middle of the drive: the wheels carry it through, and both ends are one map.
TEST(Mapper, OdometryCarriesTheDriveThroughTheDark) {
  const std::vector<Eigen::Isometry3d> drive = shortDrive(70, -30.0, 210.0);
  test::SyntheticSensor sensor = noisySensor();
  for (int i = 20; i < 50; ++i) {
    sensor.blank_frames.insert(i);
  }
  RichRecording recording = richRecording(drive, sensor);
  const Built blind(recording);
  EXPECT_EQ(blind.result.submaps, 2);
  recording.mount = trueMount();
  recording::Trajectory odometry = recording.truth();
  const Eigen::Isometry3d T_odom_room = Eigen::Translation3d(5.0, 1.0, 0.0) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ());
  for (recording::StampedPose& pose : odometry) {
    pose.T_map_camera = T_odom_room * pose.T_map_camera * trueMount().inverse();
  }
  recording.T_odom_base = odometry;
  const Built carried(recording);
  EXPECT_EQ(carried.result.submaps, 1);
  EXPECT_GT(carried.result.carried_frames, 0);
  EXPECT_EQ(carried.result.lost_frames, 0);
  const auto tracking = nlohmann::json::parse(carried.files().at("report.json"))["tracking"];
  EXPECT_EQ(tracking["carried"], carried.result.carried_frames);
  EXPECT_EQ(tracking["lost"], 0);
  EXPECT_EQ(blind.result.carried_frames, 0);
  EXPECT_EQ(blind.result.lost_frames, carried.result.carried_frames);
  const recording::Trajectory truth = recording.truth();
  const recording::Trajectory poses = carried.trajectory();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Isometry3d T_first_now = poses[0].T_map_camera.inverse() * poses[i].T_map_camera;
    const Eigen::Isometry3d T_first_true = truth[0].T_map_camera.inverse() * truth[i].T_map_camera;
    EXPECT_LT(distance_m(T_first_now, T_first_true), 0.05) << "frame " << i;
    EXPECT_LT(turn_rad(T_first_now, T_first_true), 0.03) << "frame " << i;
  }
}

// The room is 4 m by 3 m about its origin: two places fit, and where the drive is said to begin decides.
PlanTask roomTask(const Eigen::Isometry2d& T_plan_base_expected) {
  PlanTask task;
  addRoom({{-2.0, -1.5}, {2.0, -1.5}, {2.0, 1.5}, {-2.0, 1.5}}, task.plan);
  task.source = "room.svg";
  task.frame = PlanFrame::kPlan;
  task.T_plan_base_expected = T_plan_base_expected;
  return task;
}

TEST(Mapper, AMapIsLaidOntoItsPlan) {
  const std::vector<Eigen::Isometry3d> drive = shortDrive(160, -20.0, 360.0);
  MapConfig config;
  config.walls.min_height_bins = 2;  // the camera looks down
  const Eigen::Isometry2d expected = Eigen::Translation2d(-0.3, 0.1) * Eigen::Rotation2Dd(-0.2);
  const Built built(richRecording(drive), {.plan = roomTask(expected)}, config);
  ASSERT_TRUE(built.result.placement.has_value());
  const recording::Trajectory T_room_camera = built.trajectory();
  EXPECT_LT(distance_m(T_room_camera.front().T_map_camera, drive.front()), 0.03);
  EXPECT_LT(turn_rad(T_room_camera.front().T_map_camera, drive.front()), 0.5 * std::numbers::pi / 180.0);
  EXPECT_NE(base::readFile(built.folder.path() / "report.json").find("floor_plan"), std::string::npos);
}

TEST(Mapper, AMapThatDoesNotFitItsPlanIsRefused) {
  MapConfig config;
  config.walls.min_height_bins = 2;
  PlanTask task = roomTask(Eigen::Isometry2d::Identity());
  task.plan = {};
  addRoom({{0.0, 0.0}, {9.0, 0.0}, {9.0, 2.0}, {0.0, 2.0}}, task.plan);
  test::expectError(base::ErrorCode::kInput, {"room.svg", "the map does not fit"},
                    [&] { const Built built(richRecording(shortDrive(160, -20.0, 360.0)), {.plan = task}, config); });
}

TEST(MapConfig, NamesWhatIsWrong) {
  MapConfig config;
  EXPECT_TRUE(config.validate().empty());
  config.images_in_memory = 1;
  ASSERT_EQ(config.validate().size(), 1U);
  EXPECT_NE(config.validate()[0].find("images_in_memory = 1"), std::string::npos);
}

}  // namespace
}  // namespace oikos::mapping
