// SPDX-License-Identifier: Apache-2.0
// Lengths of the rooms in a map against the true home: between opposite walls and between corners (paper 003, 6.2.1.3: within 6 cm).
//   rooms_bench [--scene NAME] [--sensor kinect1|kinect2]… [--belief-mm N]… [--threads N] [--oikos PATH] [--home HOME]
//   rooms_bench --recording RECORDING --mapped HOME
// The first way simulates a drive of the demo apartment and maps it with the defaults; the second one measures what is there.

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/routes/drive_options.h"
#include "bench/routes/route_run.h"
#include "core/geometry/ply.h"
#include "core/metrics/error_statistics.h"
#include "core/metrics/room_shape.h"
#include "core/metrics/trajectory_error.h"
#include "core/recording/trajectory.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace oikos;
using camera::DepthSensorKind;
using metrics::RoomLength;

struct Options {
  std::string scene = "drive";
  bench::DriveOptions drives{.sensors = {"kinect1"}, .command = {OIKOS_BUILT_BINARY, 0, {}}, .home = OIKOS_DEMO_HOME};
  fs::path recording;
  fs::path mapped;
};

/// The map's points in the frame of the true home: by the paths, so that no wall decides about its own error.
std::vector<Eigen::Vector3f> readAlignedCloud(const fs::path& recording, const fs::path& mapped) {
  const auto estimate = recording::readTrajectory(mapped / "map" / "trajectory.txt");
  const auto truth = recording::readTrajectory(recording / "groundtruth.txt");
  const metrics::TrajectoryError error = metrics::evaluateTrajectory(estimate, truth);
  if (error.status != metrics::TrajectoryErrorStatus::kEvaluated) {
    throw std::runtime_error("the paths cannot be aligned: " + std::string(base::toString(error.status)));
  }
  std::vector<Eigen::Vector3f> points = geometry::readPly(mapped / "map" / "cloud.ply").points;
  for (Eigen::Vector3f& point : points) {
    point = error.alignment.apply(point.cast<double>()).cast<float>();
  }
  return points;
}

void printLengths(const std::string& room, const char* kind, const std::vector<RoomLength>& lengths, std::vector<double>& errors_m) {
  for (const RoomLength& length : lengths) {
    std::printf("| %s | %s %zu – %zu | %.3f | %.3f | %+.1f |\n", room.c_str(), kind, length.from, length.to, length.true_m,
                length.measured_m, 1e3 * length.error_m());
    errors_m.push_back(std::abs(length.error_m()));
  }
}

void printVerdict(const char* kind, const std::vector<double>& errors_m) {
  constexpr double kMust_m = 0.02;
  constexpr double kAim_m = 0.01;
  const metrics::ErrorStatistics error_m = metrics::statisticsOf(errors_m);
  const auto verdict = [&](double limit_m) { return error_m.count > 0 && error_m.mean <= limit_m ? "met" : "NOT MET"; };
  std::printf("between %s: %d lengths, mean error %.4f m, median %.4f m, greatest %.4f m; must: <= %.2f %s; aim: <= %.2f %s\n", kind,
              error_m.count, error_m.mean, error_m.median, error_m.max, kMust_m, verdict(kMust_m), kAim_m, verdict(kAim_m));
}

void measure(const fs::path& recording, const fs::path& mapped) {
  const fs::path file = recording / "truth" / "home.xml";
  const semantic::Home home = semantic::getHome(semantic::readHome(file), file);
  const std::vector<Eigen::Vector3f> points = readAlignedCloud(recording, mapped);
  std::vector<double> walls_m;
  std::vector<double> corners_m;
  std::size_t seen = 0;
  std::size_t all = 0;
  std::printf("| room | between | true m | in the map m | error mm |\n|---|---|---|---|---|\n");
  for (const semantic::Room& room : home.rooms) {
    if (room.outline_map.size() < 3) {
      continue;
    }
    const metrics::RoomShape shape = metrics::measureRoom(room.outline_map, points);
    printLengths(room.id.value, "walls", shape.between_walls, walls_m);
    printLengths(room.id.value, "corners", shape.between_corners, corners_m);
    all += shape.walls.size();
    seen +=
        static_cast<std::size_t>(std::count_if(shape.walls.begin(), shape.walls.end(), [](const auto& wall) { return wall.has_value(); }));
  }
  std::printf("\n%zu of %zu walls seen\n", seen, all);
  printVerdict("walls", walls_m);
  printVerdict("corners", corners_m);
  std::fflush(stdout);
}

void run(const Options& options) {
  if (!options.recording.empty()) {
    measure(options.recording, options.mapped);
    return;
  }
  const test::TemporaryFolder scratch;
  for (const double belief_mm : options.drives.beliefs_mm) {
    for (const std::string& sensor : options.drives.sensors) {
      const bench::RouteCase drive{{options.scene, 0.0}, *base::findEnum<DepthSensorKind>(sensor), belief_mm * 1e-3};
      const bench::RouteScore score = runRoute(drive, options.drives.command, options.drives.home, scratch.path());
      std::printf("\n%s, %s, belief %.0f mm: %d frames, %d lost, path %.2f m, ATE RMSE %.4f m\n\n", options.scene.c_str(), sensor.c_str(),
                  belief_mm, score.frames, score.lost, score.path_m, score.ate_m);
      measure(scratch.path() / "recording", scratch.path() / "mapped");
    }
  }
}

Options parse(CLI::App& app, int argc, char** argv) {
  Options options;
  app.add_option("--scene", options.scene, "of the home, without .toml");
  bench::addDriveOptions(app, options.drives);
  CLI::Option* recording = app.add_option("--recording", options.recording, "a simulated one that is mapped already");
  CLI::Option* mapped = app.add_option("--mapped", options.mapped, "the home that it was mapped into");
  recording->check(CLI::ExistingDirectory)->needs(mapped);
  mapped->check(CLI::ExistingDirectory)->needs(recording);
  app.parse(argc, argv);
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Lengths of the rooms in a map of the simulated apartment", "rooms_bench");
  try {
    run(parse(app, argc, argv));
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rooms_bench: %s\n", error.what());
    return 1;
  }
}
