// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/camera/rgbd_frame.h"
#include "mapping/odometry/landmark.h"

namespace oikos::mapping {

struct CornerDetectorConfig {
  int cell_px = 26;                 ///< at most one new landmark per cell of this size, at 640 x 480 (scaled with the width)
  double min_response = 6.0;        ///< least eigenvalue of the mean gradient matrix (grey values squared per pixel squared)
  int enough = 200;                 ///< landmarks in view; where strong corners give fewer, weaker ones are taken too
  double min_weak_response = 1.5;   ///< of these; noise of 1.5 grey values makes none
  double max_depth_m = 8.0;         ///< farther readings make no landmark
  int depth_window_px = 5;          ///< half size of the window in which the surface is fitted
  double max_plane_residual = 2.5;  ///< RMS of inverse depth about the fitted plane, in its standard deviations

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("cell_px", cell_px);
    visitor("min_response", min_response);
    visitor("enough", enough);
    visitor("min_weak_response", min_weak_response);
    visitor("max_depth_m", max_depth_m);
    visitor("depth_window_px", depth_window_px);
    visitor("max_plane_residual", max_plane_residual);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// New landmarks of a keyframe, spread evenly: in each cell that holds no pixel of `occupied`, the strongest corner (Shi & Tomasi,
/// CVPR 1994) that lies on a smooth surface with depth; where these and `occupied` are not enough, the strongest of the weak ones, of a
/// bare wall for instance. Inverse depth and its gradient come from a plane fitted to the
/// window's inverse depths (a plane in space is linear in inverse depth); at the edge of a surface, to the nearer side's. `host` is left
/// for the caller.
[[nodiscard]] std::vector<Landmark> detectCorners(const camera::RgbdFrame& frame, const std::vector<Eigen::Vector2d>& occupied,
                                                  const CornerDetectorConfig& config);

}  // namespace oikos::mapping
