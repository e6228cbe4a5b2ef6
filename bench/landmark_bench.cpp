// SPDX-License-Identifier: Apache-2.0
// How well the fixed furniture corrects where the robot believes to be: a simulated drive through the kitchen of the demo home, kinect1,
// the home believed wrongly by so many millimetres, from `prior.txt` (5 cm, 3 degrees), each frame on its own.
//   landmark_bench [--belief-mm MM]… [--frames N] [--seed N] [--recording FOLDER] [--set KEY=VALUE]…
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/locate/locate_score.h"
#include "core/base/atomic_file.h"
#include "core/base/config.h"
#include "core/recording/recording.h"
#include "core/recording/trajectory.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate/scene_script.h"
#include "tools/simulate/simulator.h"
#include "tracking/localisation/home_landmarks.h"
#include "tracking/localisation/localiser.h"

namespace {

using namespace oikos;
using namespace oikos::bench;
namespace fs = std::filesystem;

struct Options {
  std::vector<double> belief_mm = {0.0, 5.0, 10.0};
  int frames = 500;
  std::uint64_t seed = 1;
  int min_landmarks = 6;
  bool has_mount_error = false;
  fs::path recordings;  ///< empty: simulated into a temporary folder
  std::vector<std::string> settings;
};

/// Dimensions as from a tape, pieces put down as by hand, hinges and walls likewise: with 5 mm go 0.3 degrees.
simulate::BeliefSettings beliefOf(double error_m, bool has_mount_error) {
  constexpr double kDegPerMetre = 60.0;
  simulate::BeliefSettings belief;
  belief.dimension_m = error_m;
  belief.placement_m = error_m;
  belief.placement_deg = kDegPerMetre * error_m;
  belief.axis_m = error_m;
  belief.axis_deg = kDegPerMetre * error_m;
  belief.wall_deg = kDegPerMetre * error_m;
  belief.mount_m = has_mount_error ? error_m : 0.0;
  belief.mount_deg = has_mount_error ? kDegPerMetre * error_m : 0.0;
  return belief;
}

simulate::SceneScript kitchenDrive(double error_m, const Options& options) {
  simulate::SceneScript script;
  script.rate_hz = 10.0;
  script.duration_s = options.frames / script.rate_hz;
  script.sensor = camera::DepthSensorKind::kKinect1;
  script.camera.jpeg_quality = 50;
  script.camera.height_m = 1.2;  // a head's, which looks at the front of the room rather than at the floor
  script.camera.tilt_deg = 3.0;
  script.path.start = {0.5, 1.2, 90.0};
  script.path.waypoints = {"0.6 1.3 look 15",    "0.75 1.45 look -20", "0.9 1.5 look 10",  "1.1 1.65 look 25",
                           "1.05 1.75 look -15", "0.9 1.85 look -10",  "0.85 2.0 look 20", "0.9 2.1 look -15"};
  script.path.speed_mps = 0.15;
  script.path.turn_rate_dps = 15.0;
  script.belief = beliefOf(error_m, options.has_mount_error);
  return script;
}

fs::path simulated(double belief_mm, const Options& options, const fs::path& scratch) {
  const std::string name = "belief-" + std::to_string(static_cast<int>(belief_mm)) + "-seed-" + std::to_string(options.seed);
  const fs::path folder = (options.recordings.empty() ? scratch : options.recordings) / name;
  if (fs::exists(folder / "prior.txt")) {
    return folder;
  }
  fs::create_directories(scratch / "home" / "scenes");
  fs::copy_file(fs::path(OIKOS_DEMO_HOME) / "home.xml", scratch / "home" / "home.xml", fs::copy_options::overwrite_existing);
  const fs::path scene = scratch / "home" / "scenes" / (name + ".toml");
  base::writeFileAtomically(scene, base::writeConfig(kitchenDrive(belief_mm * 1e-3, options)));
  fs::create_directories(folder);
  (void)simulate::simulate({scene, folder, options.seed, 2, {}});
  return folder;
}

int used(const registration::LandmarkRefinement& refinement) {
  return static_cast<int>(std::count_if(refinement.landmarks.begin(), refinement.landmarks.end(), [](const auto& piece) {
    return piece.verdict == registration::LandmarkVerdict::kUsed || piece.verdict == registration::LandmarkVerdict::kChanged;
  }));
}

void runBelief(double belief_mm, const Options& options, const fs::path& scratch) {
  const fs::path folder = simulated(belief_mm, options, scratch);
  const auto recording = recording::openRecording(folder);
  const semantic::Home home = semantic::getHome(semantic::readHome(fs::path(OIKOS_DEMO_HOME) / "home.xml"), "home.xml");
  registration::LandmarkScene furniture = tracking::makeLandmarks(home, OIKOS_DEMO_HOME);
  const tracking::PosePrior prior(recording::readTrajectory(folder / "prior.txt"), recording->T_base_camera().value());
  base::ConfigLayers layers;
  for (const std::string& text : options.settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  auto config = base::loadConfig<tracking::LocaliseConfig>(layers);
  tracking::LocaliserTools tools{recording->camera()};
  tools.furniture = &furniture;
  tools.T_base_camera = recording->T_base_camera().value();
  tools.prior = &prior;
  tracking::Localiser localiser(tools, config);
  const auto truth = recording::readTrajectory(folder / "groundtruth.txt");
  std::vector<FrameScore> before;
  std::vector<FrameScore> after;
  std::map<std::string, int> statuses;
  int few = 0;
  for (int i = 0; i < recording->frameCount(); ++i) {
    const camera::RgbdFrame frame = recording->read(i, recording::Channels::kGray);
    const auto begin = std::chrono::steady_clock::now();
    const tracking::LocatedPose located = localiser.add(frame);
    const double latency_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++statuses[std::string(base::toString(located.landmarks->status))];
    if (used(*located.landmarks) < options.min_landmarks) {
      ++few;
      continue;
    }
    const Eigen::Isometry3d& T_map_camera = truth[static_cast<std::size_t>(i)].T_map_camera;
    before.push_back(scoreFrame(*located.T_map_camera_before, T_map_camera, geometry::Matrix6d::Identity()));
    after.push_back(scoreFrame(located.T_map_camera, T_map_camera, located.covariance));
    after.back().found = located.source == tracking::PoseSource::kLandmarks;
    after.back().latency_s = latency_s;
    if (std::getenv("OIKOS_BENCH_FRAMES") != nullptr) {
      const auto& r = *located.landmarks;
      std::printf("%3d %-12s %.2f cm %.2f deg nees %.1f n %d rounds %d overlap %.2f sig %.4f", i,
                  std::string(base::toString(r.status)).c_str(), 100 * after.back().error_m, after.back().error_deg, after.back().nees,
                  used(r), r.rounds, r.overlap, std::sqrt(r.covariance.topLeftCorner<3, 3>().trace()));
      for (const auto& p : r.landmarks)
        if (p.verdict == registration::LandmarkVerdict::kMoved || !p.dropped_parts.empty()) {
          std::printf(" %s:%s %.1f", p.id.c_str(), std::string(base::toString(p.verdict)).c_str(), p.contradiction);
          for (auto& d : p.dropped_parts)
            std::printf(",%s", d.c_str());
        }
      std::printf("\n");
    }
  }
  const std::string name = std::to_string(static_cast<int>(belief_mm)) + " mm";
  printFrameScores(name + ", prior", before);
  printFrameScores(name + ", refined", after);
  std::printf("  %d frames with fewer than %d pieces;", few, options.min_landmarks);
  for (const auto& [status, count] : statuses) {
    std::printf(" %s %d", status.c_str(), count);
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How well fixed furniture corrects where the robot believes to be", "landmark_bench");
  Options options;
  app.add_option("--belief-mm", options.belief_mm, "by how much the believed home is wrong");
  app.add_option("--frames", options.frames, "of the drive")->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of the drive and of what is wrong");
  app.add_option("--min-landmarks", options.min_landmarks, "frames that use fewer pieces are left out");
  app.add_flag("--mount", options.has_mount_error, "the camera's mount is wrong, too");
  app.add_option("--recordings", options.recordings, "keep the drives there, and take them from there");
  app.add_option("--set", options.settings, "KEY=VALUE of the localisation; may be repeated");
  try {
    app.parse(argc, argv);
    const test::TemporaryFolder scratch;
    printScoreHead();
    for (const double belief_mm : options.belief_mm) {
      runBelief(belief_mm, options, scratch.path());
    }
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "landmark_bench: %s\n", error.what());
    return 1;
  }
}
