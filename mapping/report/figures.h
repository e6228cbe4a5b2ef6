// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mapping/report/report.h"

namespace oikos::mapping {

/// What follows from a report's facts, counted once for the page, the data and the summary.
struct ReportFigures {
  int frames = 0;
  int tracked = 0;
  int relocalised = 0;
  int carried = 0;  ///< by odometry: they are not lost
  int lost = 0;
  int keyframes = 0;
  int loops_accepted = 0;
  int loops_to_earlier = 0;  ///< of these: to a place of an earlier drive
  int loops_down_weighted = 0;
  int loops_rejected = 0;
  double drive_s = 0.0;               ///< first to last stamp of the recording
  double path_m = 0.0;                ///< along the final trajectory
  double largest_correction_m = 0.0;  ///< greatest distance between a frame's place before and after loop closure
  double median_residual_px = 0.0;    ///< over the frames that have one; NaN: none has
  double median_inliers = 0.0;        ///< over the frames that are neither lost nor carried
  double free_area_m2 = 0.0;          ///< of the 2D grid
};

/// Breaks the contract when the report's vectors do not belong together.
[[nodiscard]] ReportFigures figuresOf(const MapReport& report);

}  // namespace oikos::mapping
