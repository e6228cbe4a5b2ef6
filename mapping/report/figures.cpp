// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/figures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/metrics/error_statistics.h"

namespace oikos::mapping {

namespace {

void checkConsistent(const MapReport& report) {
  OIKOS_CHECK(report.trajectory.size() == report.frames.size());
  OIKOS_CHECK(report.trajectory_before_loops.empty() || report.trajectory_before_loops.size() == report.frames.size());
  const int frames = static_cast<int>(report.frames.size());
  for (const LoopFacts& loop : report.loops) {
    OIKOS_CHECK(!loop.is_to_earlier_drive || report.extension);
    const int targets = loop.is_to_earlier_drive ? static_cast<int>(report.extension->trajectory.size()) : frames;
    OIKOS_CHECK(loop.from_frame >= 0 && loop.from_frame < frames && loop.to_frame >= 0 && loop.to_frame < targets);
  }
}

double medianOf(std::vector<double> values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : metrics::statisticsOf(std::move(values)).median;
}

void countFrames(const MapReport& report, ReportFigures& figures) {
  std::vector<double> residuals_px;
  std::vector<double> inliers;
  for (const FrameFacts& frame : report.frames) {
    figures.tracked += frame.status == FrameStatus::kTracked ? 1 : 0;
    figures.relocalised += frame.status == FrameStatus::kRelocalised ? 1 : 0;
    figures.carried += frame.status == FrameStatus::kCarried ? 1 : 0;
    figures.lost += frame.status == FrameStatus::kLost ? 1 : 0;
    figures.keyframes += frame.is_keyframe ? 1 : 0;
    if (std::isfinite(frame.residual_px) && frame.inliers > 0) {
      residuals_px.push_back(frame.residual_px);
    }
    if (frame.status != FrameStatus::kLost && frame.status != FrameStatus::kCarried) {
      inliers.push_back(frame.inliers);
    }
  }
  figures.frames = static_cast<int>(report.frames.size());
  figures.median_residual_px = medianOf(std::move(residuals_px));
  figures.median_inliers = medianOf(std::move(inliers));
}

void countLoops(const MapReport& report, ReportFigures& figures) {
  for (const LoopFacts& loop : report.loops) {
    figures.loops_accepted += loop.verdict == LoopVerdict::kAccepted ? 1 : 0;
    figures.loops_to_earlier += loop.verdict == LoopVerdict::kAccepted && loop.is_to_earlier_drive ? 1 : 0;
    figures.loops_down_weighted += loop.verdict == LoopVerdict::kDownWeighted ? 1 : 0;
  }
  figures.loops_rejected = static_cast<int>(report.loops.size()) - figures.loops_accepted - figures.loops_down_weighted;
}

void measurePath(const MapReport& report, ReportFigures& figures) {
  const recording::Trajectory& path = report.trajectory;
  if (path.empty()) {
    return;
  }
  figures.drive_s = static_cast<double>(path.back().stamp_ns - path.front().stamp_ns) * 1e-9;
  for (std::size_t i = 1; i < path.size(); ++i) {
    figures.path_m += (path[i].T_map_camera.translation() - path[i - 1].T_map_camera.translation()).norm();
  }
  for (std::size_t i = 0; i < report.trajectory_before_loops.size(); ++i) {
    const Eigen::Vector3d before = report.trajectory_before_loops[i].T_map_camera.translation();
    figures.largest_correction_m = std::max(figures.largest_correction_m, (path[i].T_map_camera.translation() - before).norm());
  }
}

}  // namespace

ReportFigures figuresOf(const MapReport& report) {
  checkConsistent(report);
  ReportFigures figures;
  countFrames(report, figures);
  countLoops(report, figures);
  measurePath(report, figures);
  const double cell_m = report.grid.cells.empty() ? report.volume.resolution_m : report.grid.resolution_m;
  figures.free_area_m2 = static_cast<double>(report.volume.cells_free) * cell_m * cell_m;
  return figures;
}

}  // namespace oikos::mapping
