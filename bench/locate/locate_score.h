// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/geometry/se3.h"

namespace oikos::bench {

/// What one frame's answer was like.
struct FrameScore {
  bool found = false;
  double error_m = 0.0;
  double error_deg = 0.0;
  double nees = 0.0;       ///< xi^T covariance^-1 xi, 6 if the covariance is honest
  double latency_s = 0.0;  ///< from decoded frame to answer
};

/// Against the truth: right perturbation of the estimate that makes it the truth.
[[nodiscard]] FrameScore scoreFrame(const Eigen::Isometry3d& T_map_camera, const Eigen::Isometry3d& T_map_camera_true,
                                    const geometry::Matrix6d& covariance);

/// The value below which this share of the values is; they must not be empty.
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// One line: found, within 5 cm and 5 degrees with its 95 % interval, medians, means, 95th percentiles, normalised squared error, latency.
/// A frame that was not found counts as outside.
void printFrameScores(const std::string& name, const std::vector<FrameScore>& scores);
void printScoreHead();

}  // namespace oikos::bench
