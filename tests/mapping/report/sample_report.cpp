// SPDX-License-Identifier: Apache-2.0
#include "tests/mapping/report/sample_report.h"

#include <numbers>
#include <opencv2/core.hpp>

namespace oikos::mapping::test {

namespace {

constexpr int kFrames = 40;

Eigen::Vector3d onSquare(int i) {
  const double along_m = 0.1 * (i % 10);
  switch (i / 10) {
    case 0:
      return {along_m, 0.0, 1.25};
    case 1:
      return {1.0, along_m, 1.25};
    case 2:
      return {1.0 - along_m, 1.0, 1.25};
    default:
      return {0.0, 1.0 - along_m, 1.25};
  }
}

void addFrames(MapReport& report) {
  for (int i = 0; i < kFrames; ++i) {
    recording::StampedPose pose;
    pose.stamp_ns = 5'000'000'000 + i * 100'000'000LL;
    pose.T_map_camera.translation() = onSquare(i);
    report.trajectory.push_back(pose);
    pose.T_map_camera.translation().x() += 0.08 * i / (kFrames - 1);
    report.trajectory_before_loops.push_back(pose);
    report.frames.push_back({.status = FrameStatus::kTracked, .inliers = 200 + i, .residual_px = 0.5, .is_keyframe = i % 4 == 0});
  }
}

GridPicture sampleGrid() {
  GridPicture grid{cv::Mat(20, 30, CV_8UC1, cv::Scalar(254)), 0.1, {-1.0, -0.5}};
  grid.cells.row(0).setTo(cv::Scalar(0));
  return grid;
}

}  // namespace

MapReport sampleReport() {
  MapReport report;
  report.recording = {.format = "tum",
                      .frames_listed = 42,
                      .frames_read = kFrames,
                      .skipped = 1,
                      .unmatched = 1,
                      .duplicates = 3,
                      .messages = {{"rgb/0012.png", "truncated at byte 1203"}},
                      .camera = {640, 480, 525.5, 526.5, 319.5, 239.5}};
  addFrames(report);
  report.loops = {{36, 0, 77, 0.625, LoopVerdict::kAccepted}, {20, 4, 16, 1.75, LoopVerdict::kRejectedByConsistency}};
  report.optimisation = {1234.5, 234.25, 17, true, {{"depth_scale", 1.0, 1.0125}, {"rolling_shutter_readout_s", 0.0, 0.028}}};
  report.floor = {FloorSighting::kFound, 1.25};
  report.volume = {.resolution_m = 0.1,
                   .voxels_occupied = 4821,
                   .voxels_free = 1234567,
                   .cells_occupied = 30,
                   .cells_free = 570,
                   .cloud_points = 98765,
                   .mesh_triangles = 54321,
                   .box_min_m = {-1.0, -0.5, 0.0},
                   .box_max_m = {2.0, 1.5, 2.5}};
  report.grid = sampleGrid();
  return report;
}

MapReport reportOnPlan() {
  MapReport report = sampleReport();
  PlanFacts plan;
  plan.T_plan_map.translation() = Eigen::Vector2d(7.5, -2.0);
  plan.T_map_base.linear() << 0.0, -1.0, 1.0, 0.0;
  plan.plan_m = 76.5;
  plan.supported_share = 0.75;
  plan.on_plan_share = 0.625;
  plan.rms_m = 0.0125;
  plan.crossed_m = 0.25;
  plan.missing_m = 0.5;
  plan.floor_outside_m2 = 0.125;
  plan.beyond_share = 0.03125;
  plan.lines_map = {{Eigen::Vector2d(-1.0, -0.5), Eigen::Vector2d(2.0, -0.5)}};
  report.plan = plan;
  return report;
}

MapReport extendedReport() {
  MapReport report = sampleReport();
  report.drives = {{0, 3, 0}, {3, kFrames, 12}};
  ExtensionFacts extension;
  for (int i = 0; i < 3; ++i) {
    recording::StampedPose pose;
    pose.stamp_ns = i * 100'000'000LL;
    pose.T_map_camera.translation() = Eigen::Vector3d(-0.2 * i, 0.5, 1.25);
    extension.trajectory.push_back(pose);
  }
  extension.keyframes = 2;
  extension.witnesses = 1;
  extension.largest_move_m = 0.0125;
  Change change;
  change.kind = ChangeKind::kGone;
  change.center_map = Eigen::Vector3d(0.5, 0.25, 0.375);
  change.size_m = Eigen::Vector3d(0.5, 0.5, 0.75);
  change.confidence = 0.875;
  extension.changes = {change};
  extension.explanation.pieces = {"chair-1"};
  MovedPieceFacts table{"table", Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity(), 3, 0.0025};
  table.T_map_after = Eigen::Translation3d(0.25, 0.0, 0.0) * Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ());
  extension.explanation.moved = {table};
  report.extension = extension;
  report.loops.push_back({10, 2, 55, 0.5, LoopVerdict::kAccepted});
  report.loops.back().is_to_earlier_drive = true;
  return report;
}

}  // namespace oikos::mapping::test
