// SPDX-License-Identifier: Apache-2.0
// Small objects of the demo home that have gone from their places: how many are missed in a few located depth images of what carries them,
// and how many of those still there are missed wrongly. Each scene is another true home, believed wrongly by so many millimetres, another
// choice of what has gone, and another short way of the camera; poses are off by their covariance.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bench/missed/report.h"
#include "bench/missed/trial.h"
#include "core/base/config.h"
#include "semantic/xml/home_reader.h"

namespace {

using namespace oikos;

tracking::ObjectWatchConfig configOf(const std::vector<std::string>& settings) {
  base::ConfigLayers layers;
  for (const std::string& text : settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  return base::loadConfig<tracking::ObjectWatchConfig>(layers);
}

/// Objects with a side below 6 cm.
std::set<std::string> flatOf(const semantic::Home& home) {
  std::set<std::string> flat;
  const tracking::BelievedScene scene(home, OIKOS_DEMO_HOME, {});
  for (const tracking::WatchedObject& object : scene.objects()) {
    if (object.box_object.sizes().minCoeff() < 0.06) {
      flat.insert(object.id.value);
    }
  }
  return flat;
}

void run(const bench::MissedOptions& options, const std::vector<std::string>& settings, bool is_verbose) {
  const std::filesystem::path file = std::filesystem::path(OIKOS_DEMO_HOME) / "home.xml";
  const semantic::Home home = semantic::getHome(semantic::readHome(file), file);
  const tracking::ObjectWatchConfig config = configOf(settings);
  bench::MissedReport report(flatOf(home), is_verbose);
  for (int scene = 0; scene < options.scenes; ++scene) {
    report.add(bench::runScene(home, options, config, std::uint64_t{options.seed} * 1000 + static_cast<std::uint64_t>(scene)));
    std::fflush(stdout);
  }
  report.print(options.views);
}

}  // namespace

int main(int argc, char** argv) {
  bench::MissedOptions options;
  bool is_verbose = false;
  std::vector<std::string> settings;
  CLI::App app("Small objects that have gone, missed in located depth images of the simulated demo home", "missed_bench");
  app.add_option("--scenes", options.scenes, "true homes; in each a drive past all that carries something");
  app.add_option("--views", options.views, "images of a drive");
  app.add_option("--belief-mm", options.belief_mm, "standard deviation of believed dimensions and places");
  app.add_option("--pose-mm", options.pose_mm, "standard deviation of the camera's place,");
  app.add_option("--pose-deg", options.pose_deg, "and direction, each axis");
  app.add_option("--sensor", options.sensor)->check(CLI::IsMember({"kinect1", "kinect2"}));
  app.add_option("--seed", options.seed);
  app.add_flag("--verbose", is_verbose, "each that was not missed");
  app.add_option("--set", settings, "any parameter of the watch, as KEY=VALUE")->allow_extra_args(false);
  CLI11_PARSE(app, argc, argv);
  try {
    run(options, settings, is_verbose);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "missed_bench: %s\n", error.what());
    return 1;
  }
}
