// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/camera/rgbd_frame.h"
#include "mapping/graph/front_end.h"

namespace oikos::mapping {

/// RAMCIP D3.1, section 3.2.1.1 (S37–S49), after Endres et al., "3-D Mapping with an RGB-D Camera", T-RO 2014.
struct PairwiseConfig {
  int predecessors = 5;            ///< p: nodes just before it that a frame is matched with (S45)
  int removed = 3;                 ///< q: of these, left out of the loop search (S47)
  int drawn = 5;                   ///< n: nodes drawn at random from the graph about the frame before, with a bias to earlier ones (S48)
  int neighbourhood = 12;          ///< edges that the graph about the frame before reaches (S46)
  double loop_preference = 3.0;    ///< how much likelier a node next to a known loop is drawn (S49)
  double keyframe_overlap = 0.55;  ///< share of matched features that agree with the motion; below it a node is added (S44)
  int max_lost_frames = 5;         ///< lost for longer: a new sub-map is begun

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("predecessors", predecessors);
    visitor("removed", removed);
    visitor("drawn", drawn);
    visitor("neighbourhood", neighbourhood);
    visitor("loop_preference", loop_preference);
    visitor("keyframe_overlap", keyframe_overlap);
    visitor("max_lost_frames", max_lost_frames);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// The papers' front end: features of every frame, matched pairwise, lifted to 3D by depth; edges to several predecessors and to
/// drawn nodes of the graph. Slower and less accurate than `FrontEnd`; for comparison. Not thread-safe.
class PairwiseFrontEnd {
 public:
  PairwiseFrontEnd(const camera::PinholeCamera& camera, const PairwiseConfig& config, const FeatureConfig& features,
                   const RelativeMotionConfig& motion, std::uint64_t seed);

  void add(const camera::RgbdFrame& frame);
  /// The front end is empty afterwards.
  [[nodiscard]] FrontEndResult finish() { return std::move(result_); }

 private:
  struct Link;
  [[nodiscard]] std::vector<int> predecessors() const;
  [[nodiscard]] std::vector<int> drawLoopCandidates();
  [[nodiscard]] std::vector<int> graphAbout(int node) const;
  [[nodiscard]] bool nextToLoop(int node) const;
  [[nodiscard]] std::vector<Link> match(const camera::RgbdFrame& frame, const Features& features, const std::vector<int>& nodes);
  void addNode(const camera::RgbdFrame& frame, Features features, const Eigen::Isometry3d& T_world_camera, int submap);
  void addEdges(const std::vector<Link>& links, EdgeKind kind);
  void record(const camera::RgbdFrame& frame, TrackingStatus status, int reference, const Link* link);

  camera::PinholeCamera camera_;
  PairwiseConfig config_;
  FeatureConfig feature_config_;
  RelativeMotionConfig motion_config_;
  std::uint64_t seed_;
  std::mt19937_64 random_;
  FrontEndResult result_;
  int lost_in_a_row_ = 0;
  Eigen::Isometry3d T_world_camera_ = Eigen::Isometry3d::Identity();
};

}  // namespace oikos::mapping
