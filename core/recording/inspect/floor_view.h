// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/camera/pinhole_camera.h"

namespace oikos::recording {

/// The lowest sizeable plane of one frame whose normal agrees with image-up.
struct FloorView {
  double camera_height_m = 0.0;
  double camera_pitch_rad = 0.0;  ///< of the optical axis above the plane's horizon
};

/// RANSAC for a few planes, one after the other, over a coarse grid of depth (Fischler & Bolles 1981); deterministic for a given seed.
[[nodiscard]] std::optional<FloorView> findLowestPlane(const cv::Mat& depth_m, const camera::PinholeCamera& camera, unsigned seed);

/// What several frames agree on: some see a table only, so the largest height that enough of them share is the floor's. Empty if fewer
/// than three frames share one.
struct SharedFloor {
  FloorView view;  ///< medians
  int frames = 0;
};
[[nodiscard]] std::optional<SharedFloor> agreeOnFloor(std::vector<FloorView> views);

}  // namespace oikos::recording
