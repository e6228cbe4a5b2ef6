// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/recording/inspect/inspection.h"
#include "core/recording/recording.h"
#include "tools/command.h"
#include "tools/terminal_progress.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos inspect ~/drives/flat-3\n"
    "  oikos inspect rgbd_dataset_freiburg1_rpy --camera tum-fr1 --json\n"
    "  oikos inspect ~/drives/flat-3 --set inspection.max_turn_rate_deg_s=40\n"
    "Exits with 1 if the verdict is that the drive is to be repeated.";

struct InspectOptions {
  std::filesystem::path recording;
  std::string camera;
  std::vector<std::string> settings;
};

/// The command's parameters as a file names them.
struct InspectConfig {
  recording::InspectionConfig inspection;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("inspection", inspection);
  }
};

recording::InspectionConfig configOf(const InspectOptions& options, const GlobalOptions& global) {
  base::ConfigLayers layers{global.config, {}};
  for (const std::string& text : options.settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  recording::InspectionConfig config = base::loadConfig<InspectConfig>(layers).inspection;
  config.threads = global.threads;
  return config;
}

/// The bar is gone when it returns.
recording::Inspection inspectWithProgress(const recording::Recording& recording, const recording::InspectionConfig& config,
                                          const GlobalOptions& global) {
  TerminalProgress progress(global);
  return recording::inspect(recording, config, progress.sink());
}

ExitCode inspectRecording(const InspectOptions& options, const Session& session) {
  const recording::InspectionConfig config = configOf(options, session.options);
  const auto recording = recording::openRecording(options.recording, {.camera = options.camera});
  const recording::Inspection inspection = inspectWithProgress(*recording, config, session.options);
  std::cout << (session.options.json ? recording::toJson(inspection) : recording::toText(inspection)) << '\n';
  return inspection.verdict == recording::Verdict::kBad ? ExitCode::kNoAnswer : ExitCode::kDone;
}

}  // namespace

void addInspectCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"inspect", "Says whether a recorded drive is good enough to be mapped.", kExamples, true});
  const auto options = std::make_shared<InspectOptions>();
  command.add_option("RECORDING", options->recording, "folder of the drive: TUM RGB-D or 7-Scenes")->required();
  command.add_option("--camera", options->camera,
                     "a camera.toml, or kinect1, tum-fr1, tum-fr2, tum-fr3, icl-nuim; default: the recording's own");
  command.add_option("--set", options->settings, "any parameter, as KEY=VALUE; may be repeated")->allow_extra_args(false);
  setAction(command, [options](const Session& session) { return inspectRecording(*options, session); });
}

}  // namespace oikos::tools
