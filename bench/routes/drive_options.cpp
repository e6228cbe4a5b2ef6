// SPDX-License-Identifier: Apache-2.0
#include "bench/routes/drive_options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

namespace oikos::bench {

void addDriveOptions(CLI::App& app, DriveOptions& options) {
  app.add_option("--sensor", options.sensors, "kinect1, kinect2 or ideal")->check(CLI::IsMember({"kinect1", "kinect2", "ideal"}));
  app.add_option("--belief-mm", options.beliefs_mm, "deviation of believed lengths; the rest of [belief] goes along")
      ->check(CLI::Range(0.0, 50.0));
  app.add_option("--threads", options.command.threads, "of oikos simulate and oikos map")->check(CLI::NonNegativeNumber);
  app.add_option("--oikos", options.command.oikos, "the program to run")->check(CLI::ExistingFile);
  app.add_option("--home", options.home, "the home with the scenes")->check(CLI::ExistingDirectory);
}

}  // namespace oikos::bench
