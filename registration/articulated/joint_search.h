// SPDX-License-Identifier: Apache-2.0
// All joints of a model looked for in one image: every value of each by itself, then solved for, then compared once more. Included by this
// folder's sources only.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "registration/articulated/articulated_config.h"
#include "registration/articulated/joint_decision.h"
#include "registration/articulated/joint_profile.h"
#include "registration/articulated/joint_solver.h"
#include "registration/articulated/joint_tree.h"
#include "registration/articulated/link_layers.h"
#include "registration/articulated/scan_window.h"

namespace oikos::registration {

/// What is known so far. Evidence and sights are by link; the base's mean nothing.
struct JointFindings {
  JointEstimates estimates;
  std::vector<JointEvidence> evidence;
  std::vector<JointSight> sights;
};

/// The steps of a registration, in their order. Not thread-safe.
class JointSearch {
 public:
  /// All arguments are kept by reference. Begins at the believed values, within the joints' limits.
  JointSearch(const JointTree& tree, const ArticulatedConfig& config, LinkLayers& layers, const Standing& believed);

  /// Where the piece can be seen, whatever its joints' values.
  [[nodiscard]] PixelWindow windowOfAll(const Eigen::Isometry3d& T_map_camera, const camera::PinholeCamera& camera) const;

  /// Each joint by itself, as if no other part were there but the base: nothing is believed yet.
  void lookForJoints(JointProfiler& profiler);
  /// Two values that explain the image about as well as long as both are only roughly right: each is solved for, and judged again.
  void settleRivals(JointProfiler& profiler, JointSolver& solver);
  /// The base, the joints down the tree and, if that is the order, all of them at once.
  void solveAll(JointSolver& solver);
  /// All values once more, with everything else where it was found. True if one of them is better than what was solved for.
  bool compareAgain(JointProfiler& profiler);

  [[nodiscard]] const JointFindings& findings() const { return findings_; }
  /// All links but the base.
  [[nodiscard]] std::vector<int> movable() const;

 private:
  double& valueOf(int link);
  void listValues(int link);
  /// Scores all values of a joint, the profiler standing ready.
  void fillProfile(JointProfiler& profiler, int link);
  /// The most likely value; the believed one, where nothing speaks against it.
  [[nodiscard]] double bestValue(int link);

  const JointTree& tree_;
  const ArticulatedConfig& config_;
  LinkLayers& layers_;
  const Standing& believed_;
  JointFindings findings_;
};

}  // namespace oikos::registration
