// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/camera/rgbd_frame.h"

namespace oikos::recording {

/// Which side of the near surface a depth edge bounds.
enum class EdgeSide { kLeft, kRight, kTop, kBottom };
constexpr int kEdgeSides = 4;
constexpr int kLargestEdgeShift_px = 24;

/// For every shift of one kind of depth edges along their normal, the colour gradient that they meet there.
struct EdgeProfile {
  int edges = 0;
  std::array<std::int64_t, 2 * kLargestEdgeShift_px + 1> gradient{};  ///< summed over the edges; shift 0 in the middle
};
using EdgeProfiles = std::array<EdgeProfile, kEdgeSides>;  ///< by EdgeSide

/// Depth edges of one frame against its colour edges. Sums of integers, so that the order of frames does not matter.
[[nodiscard]] EdgeProfiles profileDepthEdges(const camera::RgbdFrame& frame);

void addProfiles(const EdgeProfiles& more, EdgeProfiles& sum);

/// The shift along one axis that brings depth edges onto colour edges. An edge that is too fat moves the two sides of things apart but
/// not their mean, which is what a wrong mount or calibration moves.
struct EdgeShift {
  double shift_px = 0.0;
  int edges = 0;
  bool is_known = false;
};
[[nodiscard]] EdgeShift findEdgeShift(const EdgeProfile& low_side, const EdgeProfile& high_side);

}  // namespace oikos::recording
