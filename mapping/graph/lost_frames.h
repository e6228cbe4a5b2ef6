// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "core/camera/rgbd_frame.h"
#include "mapping/graph/front_end.h"
#include "mapping/graph/keyframe_images.h"

namespace oikos::mapping {

struct LostFrameTools {
  const camera::PinholeCamera& camera;
  const FollowerConfig& follower;
  KeyframeImages& images;
  std::function<camera::RgbdFrame(int frame)> read;
  int pyramid_levels = 5;
};

/// Tries the frames that tracking lost once more with all that is known by now: from the frame before, then from the frame after, against
/// the refined landmarks. Frames that are found get their observations and the status kRelocalised. `T_world_frame`: one pose a
/// frame; changed for the frames found. Returns how many were found.
int retryLostFrames(const KeyframeGraph& graph, const LostFrameTools& tools, std::vector<TrackedFrame>& frames,
                    std::vector<Eigen::Isometry3d>& T_world_frame);

/// Gives frames that are still lost a pose between those before and after them, in proportion to time; at the ends of the drive and
/// between sub-maps the nearest pose is kept.
void bridgeLostFrames(const KeyframeGraph& graph, const std::vector<TrackedFrame>& frames, std::vector<Eigen::Isometry3d>& T_world_frame);

}  // namespace oikos::mapping
