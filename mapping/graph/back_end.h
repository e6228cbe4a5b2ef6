// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "mapping/graph/bundle_adjustment.h"
#include "mapping/graph/covisibility.h"
#include "mapping/graph/front_end.h"
#include "mapping/graph/loop_consistency.h"
#include "mapping/graph/pose_graph.h"

namespace oikos::mapping {

struct BackEndConfig {
  LoopConsistencyConfig loops;
  PoseGraphConfig pose_graph;
  CovisibilityConfig covisibility;
  BundleAdjustmentConfig bundle;
  bool bundle_adjustment = true;   ///< false: the pose graph's answer stands
  bool rolling_shutter = true;     ///< whether a read-out time may be estimated
  double min_readout_gain = 0.18;  ///< share of the cost that a read-out time must take away to be believed

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("loops", loops);
    visitor("pose_graph", pose_graph);
    visitor("covisibility", covisibility);
    visitor("bundle", bundle);
    visitor("bundle_adjustment", bundle_adjustment);
    visitor("rolling_shutter", rolling_shutter);
    visitor("min_readout_gain", min_readout_gain);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct BackEndTools {
  const camera::PinholeCamera& camera;
  const FollowerConfig& follower;
  KeyframeImages& images;
  std::function<camera::RgbdFrame(int frame)> read;
  int pyramid_levels = 5;
  int threads = 1;
  base::ProgressSink progress;
};

struct BackEndResult {
  std::vector<Eigen::Isometry3d> T_world_frame_odometry;  ///< one a frame, before loops were closed
  std::vector<Eigen::Isometry3d> T_world_frame;           ///< one a frame, final
  std::vector<char> believed;                             ///< one an edge
  PoseGraphResult pose_graph;
  BundleAdjustmentResult bundle;
  double readout_s = 0.0;    ///< 0: not believed
  int submaps_left = 0;      ///< that no loop joined to another
  int frames_recovered = 0;  ///< lost at first, found afterwards
};

/// From the front end's graph to the best poses of all frames: mutually consistent loops → pose graph → covisible sightings → bundle
/// adjustment → each frame's own pose → lost frames. Changes the drive's graph and the status of frames that are found.
[[nodiscard]] BackEndResult optimiseDrive(FrontEndResult& drive, const std::vector<MotionPrior>& priors, const BackEndConfig& config,
                                          const BackEndTools& tools);

}  // namespace oikos::mapping
