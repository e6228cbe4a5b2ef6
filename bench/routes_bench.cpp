// SPDX-License-Identifier: Apache-2.0
// Accuracy of `oikos map` on the six routes of paper 003 (two straight, two L-shaped, two closed squares), driven in the simulated
// apartment.
//   routes_bench [--route NAME]… [--sensor kinect1|kinect2]… [--belief-mm N]… [--threads N] [--oikos PATH] [--home HOME]
// One configuration for all: the defaults. ATE is after alignment by a rigid motion; every frame counts, lost ones with the pose that they
// were given. The path is that of the camera, which turns about the robot's middle at corners.
#include <stdlib.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "bench/routes/drive_options.h"
#include "bench/routes/route_run.h"
#include "bench/routes/route_table.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos::bench;
using oikos::camera::DepthSensorKind;

struct Options {
  std::vector<std::string> routes;
  DriveOptions drives{.command = {OIKOS_BUILT_BINARY, 0, {}}, .home = OIKOS_DEMO_HOME};
};

std::vector<RouteCase> casesOf(const Options& options) {
  std::vector<RouteCase> cases;
  for (const double belief_mm : options.drives.beliefs_mm) {
    for (const std::string& sensor : options.drives.sensors) {
      for (const Route& route : paperRoutes()) {
        if (options.routes.empty() || std::ranges::count(options.routes, route.name) > 0) {
          cases.push_back({route, *oikos::base::findEnum<DepthSensorKind>(sensor), belief_mm * 1e-3});
        }
      }
    }
  }
  return cases;
}

void run(const Options& options) {
  const oikos::test::TemporaryFolder scratch;
  double load[1] = {0.0};
  (void)getloadavg(load, 1);
  std::printf("%u processors, load %.1f at the start\n", std::thread::hardware_concurrency(), load[0]);
  std::vector<RouteScore> scores;
  printRouteHeader();
  for (const RouteCase& route_case : casesOf(options)) {
    scores.push_back(runRoute(route_case, options.drives.command, options.drives.home, scratch.path()));
    printRoute(scores.back());
  }
  printRouteBars(scores);
}

Options parse(CLI::App& app, int argc, char** argv) {
  Options options;
  std::vector<std::string> names;
  for (const Route& route : paperRoutes()) {
    names.push_back(route.name);
  }
  app.add_option("--route", options.routes, "which to drive; default: all")->check(CLI::IsMember(names));
  addDriveOptions(app, options.drives);
  app.parse(argc, argv);
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Accuracy of oikos map on the six routes of paper 003 in a simulated apartment", "routes_bench");
  try {
    run(parse(app, argc, argv));
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "routes_bench: %s\n", error.what());
    return 1;
  }
}
