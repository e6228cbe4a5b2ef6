// SPDX-License-Identifier: Apache-2.0
#include "mapping/mapper.h"

#include <algorithm>
#include <map>
#include <memory>

#include "core/base/atomic_file.h"
#include "core/base/config.h"
#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/recording/frame_stream.h"
#include "mapping/floorplan/wall_views.h"
#include "mapping/graph/frame_poses.h"
#include "mapping/graph/g2o_file.h"
#include "mapping/keyframe_saver.h"
#include "mapping/map_extension.h"
#include "mapping/map_frame.h"
#include "mapping/map_report.h"
#include "mapping/odometry_priors.h"
#include "mapping/report/timing.h"
#include "mapping/stage_clock.h"

namespace oikos::mapping {

namespace {

class Mapper {
 public:
  Mapper(const recording::Recording& recording, const MapConfig& config, const MapRun& run, const std::filesystem::path& folder)
      : recording_(recording),
        config_(config),
        run_(run),
        folder_(folder),
        T_base_camera_(run.T_base_camera ? run.T_base_camera : recording.T_base_camera()),
        earlier_(openEarlierMap(recording, config, run)),
        frames_(recording, earlier_.get()),
        images_([this](int frame) { return frames_.read(frame, recording::Channels::kGray).gray; }, config.front_end.pyramid_levels,
                config.images_in_memory) {}

  MapResult build() {
    clock_.begin("tracking");
    track();
    clock_.begin("optimisation");
    optimise();
    if (earlier_ && !MapExtension::isPlaced(drive_, optimised_)) {
      MapResult result = summary();
      result.is_placed = false;
      return result;
    }
    clock_.begin(earlier_ ? "changes" : "floor");
    earlier_ ? extend() : placeInMap();
    clock_.begin("fusion");
    fuse();
    clock_.begin("writing");
    write();
    return summary();
  }

 private:
  void track() {
    const auto seed = static_cast<std::uint64_t>(run_.seed);
    const std::optional<recording::Trajectory> T_odom_base = frames_.findOdometry();
    odometry_without_mount_ = T_odom_base && !T_base_camera_;
    odometry_ = WheelOdometry(T_odom_base, T_base_camera_);
    if (config_.kind == FrontEndKind::kPairwise) {
      feed(PairwiseFrontEnd(recording_.camera(), config_.pairwise, config_.front_end.features, config_.front_end.motion, seed));
    } else {
      feed(FrontEnd({recording_.camera(), odometry_, images_}, config_.front_end, config_.back_end.loops, seed,
                    earlier_ ? earlier_->start() : FrontEndResult()));
    }
    if (drive_.frames.empty()) {
      throw base::Error(base::ErrorCode::kInput, "no frame could be read");
    }
  }

  template <class AnyFrontEnd>
  void feed(AnyFrontEnd front_end) {
    const int lookahead_threads = std::max(1, run_.threads - 1);
    recording::FrameStream stream(recording_, {.capacity = 4 + lookahead_threads, .decode_threads = lookahead_threads});
    while (const auto frame = stream.next()) {
      front_end.add(frames_.renumbered(*frame));
      base::reportProgress(run_.progress,
                           {"tracking", stream.statistics().read + stream.statistics().unreadable, stream.statistics().listed});
    }
    drive_ = front_end.finish();
    statistics_ = stream.statistics();
  }

  void optimise() {
    const BackEndTools tools{recording_.camera(),
                             config_.front_end.follower,
                             images_,
                             [this](int f) { return frames_.read(f, recording::Channels::kGray); },
                             config_.front_end.pyramid_levels,
                             run_.threads,
                             run_.progress};
    const std::vector<MotionPrior> priors = motionPriors(odometry_, drive_.graph);
    optimised_ = optimiseDrive(drive_, priors, config_.back_end, tools);
    carried_ = carryLostFrames(odometry_, drive_.frames, optimised_.T_world_frame);
    forgetObservations();
  }

  /// Everything that only the optimisation needed: it grows with the drive, and fusion needs the room.
  void forgetObservations() {
    images_.clear();
    for (TrackedFrame& frame : drive_.frames) {
      frame.observations = {};
    }
    for (Node& node : drive_.graph.nodes) {
      node.observations = {};
    }
    for (Edge& edge : drive_.graph.edges) {
      edge.observations = {};
    }
  }

  [[nodiscard]] FusionInput fusionInput() const {
    return {recording_.camera(),
            [this](int frame, bool color) { return frames_.read(frame, color ? recording::Channels::kColor : recording::Channels::kGray); },
            run_.threads, run_.progress};
  }

  /// Keyframes of the sub-map that the drive began with (what no loop joined to it has no place in its map), or all its frames.
  [[nodiscard]] std::vector<View> views() const {
    std::vector<View> chosen;
    const int submap = drive_.graph.nodes[static_cast<std::size_t>(mainSubmapNode())].submap;
    if (config_.volume.every_frame) {
      for (int node = 0; node < drive_.graph.settled; ++node) {  // of earlier drives the keyframes are left
        const Node& keyframe = drive_.graph.nodes[static_cast<std::size_t>(node)];
        chosen.push_back({keyframe.frame, keyframe.T_world_camera});
      }
      for (std::size_t i = 0; i < drive_.frames.size(); ++i) {
        const TrackedFrame& frame = drive_.frames[i];
        if (frame.status != TrackingStatus::kLost && drive_.graph.nodes[static_cast<std::size_t>(frame.reference)].submap == submap) {
          chosen.push_back({frame.frame, optimised_.T_world_frame[i]});
        }
      }
      return chosen;
    }
    for (const Node& node : drive_.graph.nodes) {
      if (node.keyframe && node.submap == submap) {
        chosen.push_back({node.frame, node.T_world_camera});
      }
    }
    return chosen;
  }

  /// A node of the sub-map with most frames; the first of equals.
  [[nodiscard]] int mainSubmapNode() const {
    if (earlier_) {
      return 0;  // of the map that is extended
    }
    std::map<int, int> frames;
    for (const TrackedFrame& frame : drive_.frames) {
      ++frames[drive_.graph.nodes[static_cast<std::size_t>(frame.reference)].submap];
    }
    const int submap =
        std::max_element(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
    const auto node = std::find_if(drive_.graph.nodes.begin(), drive_.graph.nodes.end(), [&](const Node& n) { return n.submap == submap; });
    return static_cast<int>(node - drive_.graph.nodes.begin());
  }

  /// Moves everything from the graph's world into the map.
  void placeInMap() {
    base::reportProgress(run_.progress, {"looking for the floor", 0, 0});
    floor_ = findFloor(views(), fusionInput(), config_.volume);
    moveWorld(mapFrame(floor_, optimised_.T_world_frame.front(), T_base_camera_));
    if (run_.plan) {
      layOntoPlan(*run_.plan);
    }
  }

  /// The earlier map's frame stands; what the drive has seen to be otherwise is forgotten, and kept as it is now.
  void extend() {
    floor_.status = earlier_->isFloorFound() ? FloorStatus::kFound : FloorStatus::kNoFloor;
    floor_.camera_height_m = optimised_.T_world_frame.front().translation().z();
    extension_.emplace(*earlier_);
    extension_->revise(drive_, optimised_, {fusionInput(), config_.volume.occupancy, config_.front_end, config_.revision, run_.explain});
    std::vector<Eigen::Isometry3d> T_map_keyframe;
    for (int node = 0; node < drive_.graph.settled; ++node) {
      T_map_keyframe.push_back(drive_.graph.nodes[static_cast<std::size_t>(node)].T_world_camera);
    }
    frames_.forget(extension_->gone(), std::move(T_map_keyframe));
  }

  void moveWorld(const Eigen::Isometry3d& T_map_world) {
    for (Node& node : drive_.graph.nodes) {
      node.T_world_camera = T_map_world * node.T_world_camera;
    }
    for (auto* poses : {&optimised_.T_world_frame, &optimised_.T_world_frame_odometry}) {
      for (Eigen::Isometry3d& T : *poses) {
        T = T_map_world * T;
      }
    }
  }

  /// What mapFrame gave is the level frame, with the robot's first place at its origin.
  void layOntoPlan(const PlanTask& task) {
    if (floor_.status != FloorStatus::kFound) {
      throw base::Error(base::ErrorCode::kInput, "the map cannot be laid onto it: no floor was in sight", task.source);
    }
    const WallSketch sketch = sketchWalls(views(), fusionInput(), config_.volume.surface, config_.walls);
    base::reportProgress(run_.progress, {"looking for the place on the plan", 0, 0});
    placement_ = placeOnPlan(sketch, task, config_.floor_plan);
    const Eigen::Isometry2d T_map_level = placement_->T_map_base;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear().topLeftCorner<2, 2>() = T_map_level.linear();
    T.translation().head<2>() = T_map_level.translation();
    moveWorld(T);
  }

  void fuse() {
    const GoneSpace nothing;
    KeyframeSaver saver(folder_ / "keyframes.sqlite", recording_.camera(),
                        {drive_, earlier_.get(), extension_ ? extension_->gone() : nothing});
    fused_ = fuseMap(views(), floor_.status == FloorStatus::kFound, fusionInput(), config_.volume, saver.observer(), folder_);
    saver.commit();
  }

  [[nodiscard]] recording::Trajectory trajectory(const Eigen::Isometry3d& T_camera_tracked) const {
    recording::Trajectory poses;
    for (std::size_t i = 0; i < drive_.frames.size(); ++i) {
      poses.push_back({drive_.frames[i].stamp_ns, optimised_.T_world_frame[i] * T_camera_tracked});
    }
    return poses;
  }

  void write() {
    const recording::Trajectory earlier = extension_ ? extension_->trajectory(drive_.graph) : recording::Trajectory();
    writeTrajectories(earlier);
    writeG2o(drive_.graph, optimised_.believed, folder_ / "graph.g2o");
    base::writeFileAtomically(folder_ / "config.toml", base::writeConfig(config_));
    MapReport report = makeReport(
        {recording_, statistics_, drive_, optimised_, floor_, fused_, carried_, config_.volume, odometry_without_mount_, placement_});
    report.drives = drives();
    if (extension_) {
      report.extension = {earlier,
                          drive_.graph.settled,
                          extension_->witnesses(),
                          extension_->largestMove_m(drive_.graph),
                          extension_->explanation(),
                          extension_->changes()};
    }
    base::writeFileAtomically(folder_ / "report.json", reportJson(report));
    base::writeFileAtomically(folder_ / "report.html", reportHtml(report));
    clock_.end();
    TimingReport timing;
    timing.stages = clock_.stages();
    for (const StageTime& stage : timing.stages) {
      timing.total_s += stage.wall_s;
    }
    timing.frames = static_cast<int>(drive_.frames.size());
    timing.threads = run_.threads;
    measureHost(timing);
    base::writeFileAtomically(folder_ / "timing.json", timingJson(timing));
  }

  void writeTrajectories(const recording::Trajectory& earlier) const {
    const auto write = [this](recording::Trajectory all, const recording::Trajectory& own, const char* name) {
      all.insert(all.end(), own.begin(), own.end());
      if (!all.empty()) {
        recording::writeTrajectory(all, folder_ / name);
      }
    };
    write(earlier, trajectory(Eigen::Isometry3d::Identity()), "trajectory.txt");
    write(extension_ ? extension_->baseTrajectory(earlier) : recording::Trajectory(),
          T_base_camera_ ? trajectory(T_base_camera_->inverse()) : recording::Trajectory(), "base_trajectory.txt");
  }

  [[nodiscard]] std::vector<DriveFacts> drives() const {
    std::vector<DriveFacts> all = earlier_ ? earlier_->drives() : std::vector<DriveFacts>();
    all.push_back({frames_.firstOfDrive(), static_cast<int>(drive_.frames.size()), frames_.addedToStampsS()});
    return all;
  }

  [[nodiscard]] MapResult summary() const {
    MapResult result;
    result.frames = static_cast<int>(drive_.frames.size());
    result.skipped_frames = statistics_.unreadable;
    result.carried_frames = static_cast<int>(std::count_if(carried_.begin(), carried_.end(), [](char carried) { return carried != 0; }));
    result.lost_frames = static_cast<int>(std::count_if(drive_.frames.begin(), drive_.frames.end(),
                                                        [](const TrackedFrame& f) { return f.status == TrackingStatus::kLost; })) -
                         result.carried_frames;
    result.keyframes =
        static_cast<int>(std::count_if(drive_.graph.nodes.begin(), drive_.graph.nodes.end(), [](const Node& n) { return n.keyframe; }));
    result.earlier_keyframes = drive_.graph.settled;
    if (extension_) {
      result.changes = extension_->changes();
      result.explanation = extension_->explanation();
    }
    for (std::size_t e = 0; e < drive_.graph.edges.size(); ++e) {
      result.loops += drive_.graph.edges[e].kind == EdgeKind::kLoop && optimised_.believed[e] != 0 ? 1 : 0;
    }
    result.submaps = optimised_.submaps_left;
    result.floor_found = floor_.status == FloorStatus::kFound;
    result.placement = placement_;
    return result;
  }

  const recording::Recording& recording_;
  const MapConfig& config_;
  const MapRun& run_;
  const std::filesystem::path& folder_;
  std::optional<Eigen::Isometry3d> T_base_camera_;
  std::unique_ptr<const EarlierMap> earlier_;  ///< null: a new map
  MapFrames frames_;
  KeyframeImages images_;
  StageClock clock_;
  recording::StreamStatistics statistics_;
  FrontEndResult drive_;
  WheelOdometry odometry_;
  bool odometry_without_mount_ = false;
  BackEndResult optimised_;
  std::vector<char> carried_;
  FloorResult floor_;
  std::optional<PlanPlacement> placement_;
  std::optional<MapExtension> extension_;
  FusedMap fused_;
};

}  // namespace

std::vector<std::string> MapConfig::validate() const {
  return base::ConfigRules().atLeast("images_in_memory", images_in_memory, 2).messages();
}

MapResult buildMap(const recording::Recording& recording, const MapConfig& config, const MapRun& run,
                   const std::filesystem::path& map_folder) {
  return Mapper(recording, config, run, map_folder).build();
}

}  // namespace oikos::mapping
