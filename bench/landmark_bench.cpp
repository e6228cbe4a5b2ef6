// SPDX-License-Identifier: Apache-2.0
// How well the fixed furniture corrects where the robot believes to be: a simulated drive through the kitchen of the demo home, kinect1,
// the home believed wrongly by so many millimetres, from `prior.txt` (5 cm, 3 degrees), each frame on its own. Latencies are processor time
// of one thread, from the decoded frame to the answer.
//   landmark_bench [--belief-mm MM]… [--frames N] [--drives N] [--seed N] [--object ID] [--mount] [--recordings FOLDER] [--set KEY=VALUE]…
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <map>
#include <numeric>
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
  int frames = 500;  ///< of all drives
  int drives = 5;    ///< each in another true home
  std::uint64_t seed = 1;
  int min_landmarks = 6;
  std::string object;  ///< the one landmark; empty: all
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

/// Drive n: towards the kitchen's cupboards from somewhere else each time, looking a little to both sides.
simulate::SceneScript kitchenDrive(double error_m, int drive, const Options& options) {
  constexpr std::array<double, 5> kStartX_m = {0.4, 0.7, 1.0, 1.3, 0.85};
  const double x_m = kStartX_m[static_cast<std::size_t>(drive) % kStartX_m.size()];
  const auto waypoint = [&](double aside_m, double y_m, const char* look) {
    return base::toText(x_m + aside_m) + " " + base::toText(y_m) + " look " + look;
  };
  simulate::SceneScript script;
  script.rate_hz = 10.0;
  script.duration_s = (options.frames / options.drives - 1) / script.rate_hz;
  script.sensor = camera::DepthSensorKind::kKinect1;
  script.camera.height_m = 1.2;  // a head's, which looks at the front of the room rather than at the floor
  script.camera.tilt_deg = 3.0;
  script.path.start = {x_m, 1.15, 90.0};
  script.path.waypoints = {waypoint(0.02, 1.25, "8"), waypoint(-0.02, 1.4, "-10"), waypoint(0.03, 1.55, "6"), waypoint(0.0, 1.7, "-6")};
  script.path.speed_mps = 0.15;
  script.path.turn_rate_dps = 15.0;
  script.belief = beliefOf(error_m, options.has_mount_error);
  return script;
}

fs::path simulated(double belief_mm, int drive, const Options& options, const fs::path& scratch) {
  const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(drive);
  const std::string name = "belief-" + std::to_string(static_cast<int>(belief_mm)) + "-" + std::to_string(seed);
  const fs::path folder = (options.recordings.empty() ? scratch : options.recordings) / name;
  if (fs::exists(folder / "prior.txt")) {
    return folder;
  }
  fs::create_directories(scratch / "home" / "scenes");
  fs::copy_file(fs::path(OIKOS_DEMO_HOME) / "home.xml", scratch / "home" / "home.xml", fs::copy_options::overwrite_existing);
  const fs::path scene = scratch / "home" / "scenes" / (name + ".toml");
  base::writeFileAtomically(scene, base::writeConfig(kitchenDrive(belief_mm * 1e-3, drive, options)));
  fs::create_directories(folder);
  (void)simulate::simulate({scene, folder, seed, 2, {}});
  return folder;
}

int used(const registration::LandmarkRefinement& refinement) {
  return static_cast<int>(std::count_if(refinement.landmarks.begin(), refinement.landmarks.end(), [](const auto& piece) {
    return piece.verdict == registration::LandmarkVerdict::kUsed || piece.verdict == registration::LandmarkVerdict::kChanged;
  }));
}

/// Of all drives with one belief.
struct BeliefScores {
  std::vector<FrameScore> before;
  std::vector<FrameScore> after;
  std::vector<double> planar_nees;
  std::map<std::string, int> statuses;
  int few = 0;  ///< frames that use fewer pieces than are asked for
};

/// Who says that a home is wrong by so much says it to the landmarks, too: a surface is off by its piece's place and by its dimensions.
tracking::LocaliseConfig configOf(double belief_mm, const Options& options) {
  constexpr double kPlaceAndSize = 2.0;
  const double surface_sigma_m = std::max(0.001, kPlaceAndSize * 1e-3 * belief_mm);
  base::ConfigLayers layers;
  layers.settings.push_back(base::parseSetting("landmarks.align.surface_sigma_m=" + base::toText(surface_sigma_m)));
  layers.settings.push_back(base::parseSetting("landmarks.check.surface_sigma_m=" + base::toText(std::max(0.01, surface_sigma_m))));
  for (const std::string& text : options.settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  return base::loadConfig<tracking::LocaliseConfig>(layers);
}

/// Squared error of the robot's x, y and yaw in units of the stated covariance: 3 if it is honest. (Height and tilt of the camera are the
/// prior's, which are right unless --mount.)
double planarNees(const tracking::LocatedPose& located, const Eigen::Isometry3d& T_map_camera_true, const Eigen::Vector3d& robot_camera) {
  const geometry::Vector6d xi = geometry::logSe3(located.T_map_camera.inverse() * T_map_camera_true);
  const Eigen::Matrix3d R = located.T_map_camera.linear();
  Eigen::Matrix<double, 3, 6> J = Eigen::Matrix<double, 3, 6>::Zero();
  J.topLeftCorner<2, 3>() = R.topRows<2>();
  J.topRightCorner<2, 3>() = -(R * geometry::skew(robot_camera)).topRows<2>();
  J.bottomRightCorner<1, 3>() = R.bottomRows<1>();
  const Eigen::Vector3d error = J * xi;
  const Eigen::Matrix3d covariance = J * located.covariance * J.transpose();
  return error.dot(covariance.ldlt().solve(error));
}

void runDrive(const fs::path& folder, const tracking::LocaliseConfig& config, const Options& options, BeliefScores& scores) {
  const auto recording = recording::openRecording(folder);
  const fs::path home_file = fs::path(OIKOS_DEMO_HOME) / "home.xml";
  registration::LandmarkScene furniture =
      tracking::makeLandmarks(semantic::getHome(semantic::readHome(home_file), home_file), OIKOS_DEMO_HOME);
  const tracking::PosePrior prior(recording::readTrajectory(folder / "prior.txt"), recording->T_base_camera().value());
  tracking::LocaliserTools tools{recording->camera()};
  tools.furniture = &furniture;
  if (!options.object.empty()) {
    tools.only = tracking::getLandmark(furniture, semantic::getHome(semantic::readHome(home_file), home_file), options.object);
  }
  tools.T_base_camera = recording->T_base_camera().value();
  tools.prior = &prior;
  tracking::Localiser localiser(tools, config);
  const Eigen::Vector3d robot_camera = tools.T_base_camera.inverse().translation();
  const auto truth = recording::readTrajectory(folder / "groundtruth.txt");
  for (int i = 0; i < recording->frameCount(); ++i) {
    const camera::RgbdFrame frame = recording->read(i, recording::Channels::kGray);
    const std::clock_t begin = std::clock();
    const tracking::LocatedPose located = localiser.add(frame);
    const double latency_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;  // one thread, whatever else runs
    ++scores.statuses[std::string(base::toString(located.landmarks->status))];
    if (used(*located.landmarks) < (tools.only ? 1 : options.min_landmarks)) {
      ++scores.few;
      continue;
    }
    const Eigen::Isometry3d& T_map_camera = truth[static_cast<std::size_t>(i)].T_map_camera;
    scores.before.push_back(scoreFrame(*located.T_map_camera_before, T_map_camera, geometry::Matrix6d::Identity()));
    scores.after.push_back(scoreFrame(located.T_map_camera, T_map_camera, located.covariance));
    scores.after.back().found = located.source == tracking::PoseSource::kLandmarks;
    scores.after.back().latency_s = latency_s;
    if (scores.after.back().found) {
      scores.planar_nees.push_back(planarNees(located, T_map_camera, robot_camera));
    }
  }
}

void printPlanarNees(const std::vector<double>& nees) {
  constexpr double kChi3Of95 = 7.815;
  const auto honest = std::count_if(nees.begin(), nees.end(), [](double squared) { return squared <= kChi3Of95; });
  const double count = std::max(1.0, static_cast<double>(nees.size()));
  std::printf("; of x, y and yaw NEES/3 %.2f, %.1f %% below the 95 %% limit\n",
              std::accumulate(nees.begin(), nees.end(), 0.0) / (3.0 * count), 100.0 * static_cast<double>(honest) / count);
}

void runBelief(double belief_mm, const Options& options, const fs::path& scratch) {
  BeliefScores scores;
  for (int drive = 0; drive < options.drives; ++drive) {
    runDrive(simulated(belief_mm, drive, options, scratch), configOf(belief_mm, options), options, scores);
  }
  const std::string name = std::to_string(static_cast<int>(belief_mm)) + " mm";
  printFrameScores(name + ", prior", scores.before);
  printFrameScores(name + ", refined", scores.after);
  std::printf("  %d frames use fewer than %d pieces;", scores.few, options.min_landmarks);
  for (const auto& [status, count] : scores.statuses) {
    std::printf(" %s %d", status.c_str(), count);
  }
  printPlanarNees(scores.planar_nees);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How well fixed furniture corrects where the robot believes to be", "landmark_bench");
  Options options;
  app.add_option("--belief-mm", options.belief_mm, "by how much the believed home is wrong");
  app.add_option("--frames", options.frames, "of the drive")->check(CLI::PositiveNumber);
  app.add_option("--drives", options.drives, "so many drives make up the frames, each in another true home")->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of the drive and of what is wrong");
  app.add_option("--min-landmarks", options.min_landmarks, "frames that use fewer pieces are left out");
  app.add_option("--object", options.object, "this piece alone, on demand");
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
