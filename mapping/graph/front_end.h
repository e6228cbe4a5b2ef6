// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/camera/rgbd_frame.h"
#include "mapping/graph/keyframe_graph.h"
#include "mapping/graph/keyframe_images.h"
#include "mapping/graph/loop_consistency.h"
#include "mapping/graph/place_index.h"
#include "mapping/odometry/corner_detector.h"
#include "mapping/odometry/features.h"
#include "mapping/odometry/landmark_follower.h"
#include "mapping/odometry/relative_motion.h"
#include "mapping/odometry/wheel_odometry.h"

namespace oikos::mapping {

struct FrontEndConfig {
  FeatureConfig features;
  CornerDetectorConfig corners;
  FollowerConfig follower;
  RelativeMotionConfig motion;
  int pyramid_levels = 5;
  double keyframe_overlap = 0.7;        ///< share of the landmarks seen at the last keyframe; below it a new one is due (S44)
  double keyframe_rotation_deg = 20.0;  ///< and when the view has turned by more than this
  double keyframe_parallax = 0.25;      ///< and when the camera has moved by more than this share of the median depth
  int neighbourhood = 3;                ///< keyframes this many edges away lend their landmarks
  double borrow_gain = 1.2;             ///< they do instead of a new keyframe if they give this many times what the last one saw
  int frames_a_look = 5;                ///< in a map that is extended: every so many frames landmarks that have come into view are taken
  int local_keyframes = 10;             ///< at most, those with most landmarks in view
  int loop_candidates = 4;              ///< places verified per keyframe
  int min_loop_votes = 15;
  double reuse_overlap = 0.6;  ///< share of an old keyframe's landmarks that must be seen again to take it instead of a new one
  int settled_views = 3;       ///< keyframes whose loops into a map that is extended must agree before tracking goes on in its world
  double settled_share = 0.5;  ///< and its landmarks in view must be this share of those followed until then
  int kept_sightings = 160;    ///< of a frame's landmarks, for its final pose: what is kept of every frame grows with the drive
  int max_lost_frames = 5;     ///< lost for longer: a new sub-map is begun where there is enough to follow
  WheelGate wheels;            ///< a pose that the wheels contradict is not believed: much in a home looks alike

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("features", features);
    visitor("corners", corners);
    visitor("follower", follower);
    visitor("motion", motion);
    visitor("pyramid_levels", pyramid_levels);
    visitor("keyframe_overlap", keyframe_overlap);
    visitor("keyframe_rotation_deg", keyframe_rotation_deg);
    visitor("keyframe_parallax", keyframe_parallax);
    visitor("neighbourhood", neighbourhood);
    visitor("borrow_gain", borrow_gain);
    visitor("frames_a_look", frames_a_look);
    visitor("local_keyframes", local_keyframes);
    visitor("loop_candidates", loop_candidates);
    visitor("min_loop_votes", min_loop_votes);
    visitor("reuse_overlap", reuse_overlap);
    visitor("settled_views", settled_views);
    visitor("settled_share", settled_share);
    visitor("kept_sightings", kept_sightings);
    visitor("max_lost_frames", max_lost_frames);
    visitor("wheels", wheels);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class TrackingStatus { kTracked, kRelocalised, kLost, kStart };

/// One frame of the drive as the front end saw it. Its pose hangs on a node, so that it moves along when the graph is optimised.
struct TrackedFrame {
  int frame = -1;
  std::int64_t stamp_ns = 0;
  TrackingStatus status = TrackingStatus::kLost;
  int reference = -1;  ///< node
  Eigen::Isometry3d T_reference_frame = Eigen::Isometry3d::Identity();
  std::vector<Observation> observations;  ///< until the poses are solved
  int inliers = 0;
  double rms_px = 0.0;
};

enum class LoopCheck { kTooFewMatches, kGeometryDisagrees, kWheelsDisagree, kAccepted };

struct LoopAttempt {
  int from = -1;   ///< the old node
  int frame = -1;  ///< seen again in this frame
  int votes = 0;
  int inliers = 0;
  double rms_px = 0.0;
  LoopCheck verdict = LoopCheck::kTooFewMatches;
};

struct FrontEndResult {
  KeyframeGraph graph;
  std::vector<Features> features;  ///< one a node; empty for bridges
  std::vector<TrackedFrame> frames;
  std::vector<LoopAttempt> loop_attempts;
  int submaps = 0;
  int lost_frames = 0;
  int relocalisations = 0;
  int reused_keyframes = 0;
};

/// What the front end works with; all of it outlives the front end.
struct FrontEndTools {
  const camera::PinholeCamera& camera;
  const WheelOdometry& odometry;  ///< may know nothing
  KeyframeImages& images;
};

/// From images to a graph of keyframes, one frame at a time: follows landmarks, sets keyframes where the view changes, recognises
/// places, recovers lost tracking or begins a new sub-map. Not thread-safe.
///
/// A drive that extends a map begins in a sub-map of its own beside the map's, and goes on in the map's world once loops of several
/// keyframes agree on how the two lie to each other: from then on the map's landmarks are followed, and keyframes are added only where
/// they do not suffice.
class FrontEnd {
 public:
  /// `loops`: how far tracking may stray; an old keyframe that this does not allow to be here is not taken instead of a new one.
  /// `map`: graph and features of the map to extend, all of its nodes settled; frames to come have numbers that none of them has.
  FrontEnd(const FrontEndTools& tools, const FrontEndConfig& config, const LoopConsistencyConfig& loops, std::uint64_t seed,
           FrontEndResult map = {});

  void add(const camera::RgbdFrame& frame);
  /// Every frame that was added, each on a node; if none could be followed, all are lost and hang on the first. The front end is
  /// empty afterwards.
  [[nodiscard]] FrontEndResult finish();

 private:
  struct Current;
  bool startSubmap(const Current& current);
  void bridgeTo(int node);
  void carryOn(const Current& current);
  [[nodiscard]] bool wheelsContradict(const Eigen::Isometry3d& T_world_camera) const;
  [[nodiscard]] Eigen::Isometry3d predict(const Current& current) const;
  [[nodiscard]] FollowResult follow(const Current& current, const Eigen::Isometry3d& T_world_camera,
                                    const std::vector<int>& landmarks) const;
  [[nodiscard]] std::optional<FollowResult> recover(Current& current);
  [[nodiscard]] bool keyframeDue(const FollowResult& seen) const;
  [[nodiscard]] double viewChange(const FollowResult& seen) const;
  void lookAbout(const Current& current, FollowResult& seen);
  bool borrowFromNeighbours(const Current& current, FollowResult& seen);
  void addKeyframe(Current& current, FollowResult& seen);
  struct Revisit;
  [[nodiscard]] std::optional<Revisit> verify(Current& current, const PlaceIndex::Candidate& candidate);
  [[nodiscard]] std::vector<Revisit> findRevisits(Current& current);
  const Revisit* addLoops(int node, const std::vector<Revisit>& revisits, int followed);
  [[nodiscard]] bool isInSettledWorld(int node) const;
  [[nodiscard]] bool mayGoOnFrom(const Revisit& revisit, const Edge& loop, int followed) const;
  void record(const Current& current, const FollowResult& seen, TrackingStatus status);
  int addNode(const Current& current, const Eigen::Isometry3d& T_world_camera);
  void addEdge(int from, int to, EdgeKind kind, const FollowResult& seen, const Eigen::Isometry3d& T_world_to);
  void host(const Current& current, int node, const std::vector<Observation>& seen);
  [[nodiscard]] std::vector<int> landmarksAbout(int node, int rings, const Eigen::Isometry3d& T_world_camera) const;
  void adopt(const FollowResult& seen);

  camera::PinholeCamera camera_;
  const WheelOdometry& odometry_;
  KeyframeImages& images_;
  FrontEndConfig config_;
  LoopConsistencyConfig loops_;
  std::uint64_t seed_;
  FrontEndResult result_;
  PlaceIndex places_;
  std::vector<MotionPrior> bridges_;  ///< between sub-maps, as far as the wheels know
  std::vector<int> active_;           ///< landmarks looked for in the next frame
  int reference_ = -1;                ///< node whose landmarks are seen most
  int latest_ = -1;                   ///< keyframe
  int seen_at_keyframe_ = 0;
  int frames_since_look_ = 0;
  int lost_in_a_row_ = 0;
  Eigen::Isometry3d T_world_camera_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_previous_current_ = Eigen::Isometry3d::Identity();  ///< the expected motion
  std::optional<WheelWay> wheels_ = WheelWay();                           ///< since the camera was last followed
  std::shared_ptr<const ImagePyramid> previous_;
};

}  // namespace oikos::mapping
