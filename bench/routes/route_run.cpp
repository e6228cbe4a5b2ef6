// SPDX-License-Identifier: Apache-2.0
#include "bench/routes/route_run.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "bench/mapping/mapping_score.h"
#include "core/base/config.h"
#include "core/recording/trajectory.h"
#include "tools/simulate/scene_script.h"

namespace oikos::bench {

namespace {

namespace fs = std::filesystem;

/// With 5 mm of the mount go 0.3 degrees, and 0.2 % of the focal lengths and of the width for the principal point.
/// At 5 mm what a tape and a careful installer leave, and what is out of their hands: 0.5 degrees of walls and hinges, half a percent of
/// depth.
void setBelief(simulate::BeliefSettings& belief, double belief_m) {
  if (belief_m == 0.0) {
    belief = {};
    return;
  }
  const double share = belief_m / 0.005;
  belief.dimension_m = belief_m;
  belief.axis_m = 0.003 * share;
  belief.axis_deg = 0.5 * share;
  belief.wall_deg = 0.5 * share;
  belief.extra_part_share = 0.2;
  belief.clutter = 30;
  belief.mount_m = 0.003 * share;
  belief.mount_deg = 0.2 * share;
  belief.intrinsics_share = 0.002 * share;
  belief.depth_scale_share = 0.005 * share;
}

/// A copy of the home with this one scene: a scene finds its home by where it lies.
fs::path writeScene(const RouteCase& route_case, const fs::path& home, const fs::path& scratch) {
  const std::string file = route_case.route.name + ".toml";
  simulate::SceneScript script = simulate::readSceneScript(home / "scenes" / file);
  script.sensor = route_case.sensor;
  setBelief(script.belief, route_case.belief_m);
  fs::create_directories(scratch / "home" / "scenes");
  fs::copy_file(home / "home.xml", scratch / "home" / "home.xml", fs::copy_options::overwrite_existing);
  const fs::path scene = scratch / "home" / "scenes" / file;
  std::ofstream stream(scene);
  stream << base::writeConfig(script);
  stream.close();
  if (!stream) {
    throw std::runtime_error("cannot write " + scene.string());
  }
  return scene;
}

ChildRun simulateScene(const MapCommand& command, const fs::path& scene, const fs::path& recording) {
  std::vector<std::string> words{command.oikos.string(), "simulate", scene.string(), "--out", recording.string(), "--quiet"};
  if (command.threads > 0) {
    words.insert(words.end(), {"--threads", std::to_string(command.threads)});
  }
  ChildRun run = runChild(words, recording.string() + ".out");
  if (run.exit_code != 0) {
    throw std::runtime_error("oikos simulate " + scene.string() + " ended with " + std::to_string(run.exit_code));
  }
  return run;
}

/// Of positions on a line the aligning rotation is not determined, but their distances to the truth are.
void requireFigures(const MappingScore& score) {
  using metrics::TrajectoryErrorStatus;
  if (score.error.status != TrajectoryErrorStatus::kEvaluated && score.error.status != TrajectoryErrorStatus::kUndetermined) {
    throw std::runtime_error(score.name +
                             ": the trajectory cannot be compared with the truth: " + std::string(base::toString(score.error.status)));
  }
}

}  // namespace

const std::vector<Route>& paperRoutes() {
  static const std::vector<Route> routes{{"straight1", 0.0946}, {"straight2", 0.0870}, {"l1", 0.0937},
                                         {"l2", 0.0646},        {"square1", 0.0499},   {"square2", 0.1828}};
  return routes;
}

RouteScore runRoute(const RouteCase& route_case, const MapCommand& command, const fs::path& home, const fs::path& scratch) {
  const fs::path recording = scratch / "recording";
  const fs::path mapped = scratch / "mapped";
  fs::remove_all(recording);
  fs::remove_all(mapped);
  const ChildRun simulated = simulateScene(command, writeScene(route_case, home, scratch), recording);
  const recording::Trajectory truth = recording::readTrajectory(recording / "groundtruth.txt");
  const BenchRecording bench{route_case.route.name, recording, static_cast<int>(truth.size()), truth};
  const MappingScore score = scoreRuns(bench, {mapRecording(command, recording, mapped)}, mapped);
  requireFigures(score);
  return {route_case,     score.frames, score.lost, score.error.absolute_m.rmse, score.error.truth_path_m, score.frames / simulated.wall_s,
          score.bestFps()};
}

}  // namespace oikos::bench
