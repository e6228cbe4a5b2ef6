// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/mapping/mapping_run.h"

namespace CLI {
class App;
}

namespace oikos::bench {

/// How a bench that drives through a simulated home is told what to drive.
struct DriveOptions {
  std::vector<std::string> sensors{"kinect1", "kinect2"};
  std::vector<double> beliefs_mm{0.0, 5.0};
  MapCommand command;
  std::filesystem::path home;  ///< with its scenes
};

/// `options` outlives the parsing.
void addDriveOptions(CLI::App& app, DriveOptions& options);

}  // namespace oikos::bench
