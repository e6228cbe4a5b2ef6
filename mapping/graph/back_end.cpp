// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/back_end.h"

#include <set>

#include "core/base/config_rules.h"
#include "mapping/graph/frame_poses.h"
#include "mapping/graph/lost_frames.h"

namespace oikos::mapping {

namespace {

/// Gives the nodes what the believed loops saw.
void acceptLoopObservations(KeyframeGraph& graph, const std::vector<char>& believed) {
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (believed[e] == 0) {
      continue;
    }
    Node& node = graph.nodes[static_cast<std::size_t>(graph.edges[e].to)];
    std::set<int> known;
    for (const Observation& o : node.observations) {
      known.insert(o.landmark);
    }
    for (const Observation& o : graph.edges[e].observations) {
      if (known.insert(o.landmark).second) {
        node.observations.push_back(o);
      }
    }
  }
}

class Refiner {
 public:
  Refiner(FrontEndResult& drive, const BackEndConfig& config, const BackEndTools& tools, BackEndResult& result)
      : drive_(drive), config_(config), tools_(tools), result_(result) {}

  void run() {
    updateVelocities(posesFromReferences(drive_.graph, drive_.frames));
    if (config_.bundle_adjustment) {
      tell("matching keyframes");
      addCovisibleObservations(drive_.graph, tools_.camera, tools_.images, tools_.follower, config_.covisibility, tools_.threads);
      thinSightings(drive_.graph, config_.covisibility.max_sightings);
      tell("refining the map");
      result_.bundle = adjustBundle(drive_.graph, tools_.camera, 0.0, Readout::kFixed, config_.bundle);
      if (config_.rolling_shutter) {
        updateVelocities(posesFromReferences(drive_.graph, drive_.frames));
        tryReadout();
      }
    }
    solveFrames();
    const LostFrameTools lost{tools_.camera, tools_.follower, tools_.images, tools_.read, tools_.pyramid_levels};
    result_.frames_recovered = retryLostFrames(drive_.graph, lost, drive_.frames, result_.T_world_frame);
    if (result_.frames_recovered > 0) {
      updateVelocities(result_.T_world_frame);
      solveFrames();
    }
    bridgeLostFrames(drive_.graph, drive_.frames, result_.T_world_frame);
  }

 private:
  void tell(const char* stage) const { base::reportProgress(tools_.progress, {stage, 0, 0}); }

  void updateVelocities(const std::vector<Eigen::Isometry3d>& T_world_frame) {
    velocities_ = velocitiesOf(drive_.frames, T_world_frame);
    setNodeVelocities(drive_.graph, drive_.frames, velocities_);
  }

  /// A camera that reads out row by row leaves residuals that a read-out time takes away. One that hardly helps is not believed:
  /// where motion is slow it takes up other errors.
  void tryReadout() {
    constexpr int kTrialIterations = 4;
    KeyframeGraph trial = drive_.graph;
    BundleAdjustmentConfig short_run = config_.bundle;
    short_run.max_iterations = kTrialIterations;
    const BundleAdjustmentResult tried = adjustBundle(trial, tools_.camera, 0.0, Readout::kRefined, short_run);
    if (!tried.usable || tried.final_cost > (1.0 - config_.min_readout_gain) * tried.initial_cost) {
      return;
    }
    drive_.graph = std::move(trial);
    updateVelocities(posesFromReferences(drive_.graph, drive_.frames));
    const int iterations_before = result_.bundle.iterations + tried.iterations;
    const double initial_cost = result_.bundle.initial_cost;
    result_.bundle = adjustBundle(drive_.graph, tools_.camera, tried.readout_s, Readout::kRefined, config_.bundle);
    result_.bundle.iterations += iterations_before;
    result_.bundle.initial_cost = initial_cost;
    result_.readout_s = result_.bundle.readout_s;
  }

  void solveFrames() {
    result_.T_world_frame = solveFramePoses(drive_.graph, drive_.frames, {tools_.camera, result_.readout_s}, velocities_,
                                            config_.bundle.pixel_sigma_px, tools_.threads);
  }

  FrontEndResult& drive_;
  const BackEndConfig& config_;
  const BackEndTools& tools_;
  BackEndResult& result_;
  std::vector<geometry::Vector6d> velocities_;
};

}  // namespace

std::vector<std::string> BackEndConfig::validate() const {
  return base::ConfigRules().between("min_readout_gain", min_readout_gain, 0.0, 1.0).messages();
}

BackEndResult optimiseDrive(FrontEndResult& drive, const std::vector<MotionPrior>& priors, const BackEndConfig& config,
                            const BackEndTools& tools) {
  BackEndResult result;
  base::reportProgress(tools.progress, {"closing loops", 0, 0});
  result.T_world_frame_odometry = posesFromReferences(drive.graph, drive.frames);
  result.believed = consistentEdges(drive.graph, priors, config.loops);
  result.submaps_left = joinSubmaps(drive.graph, result.believed, priors);
  result.pose_graph = optimisePoseGraph(drive.graph, result.believed, priors, config.pose_graph);
  acceptLoopObservations(drive.graph, result.believed);
  Refiner(drive, config, tools, result).run();
  return result;
}

}  // namespace oikos::mapping
