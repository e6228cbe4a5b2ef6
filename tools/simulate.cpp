// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/posix_file.h"
#include "core/base/staging_folder.h"
#include "tools/command.h"
#include "tools/interrupts.h"
#include "tools/simulate/simulator.h"
#include "tools/terminal_progress.h"

namespace oikos::tools {

namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples =
    "  oikos simulate homes/demo/scenes/drive.toml --out ~/drives/demo\n"
    "  oikos simulate homes/demo/scenes/states.toml --out ~/drives/demo-2 --seed 7";

struct SimulateOptions {
  fs::path script;
  fs::path out;
};

ExitCode simulateScene(const SimulateOptions& options, const Session& session) {
  const fs::path out = fs::absolute(options.out).lexically_normal();
  const fs::path target = out.filename().empty() ? out.parent_path() : out;
  if (fs::exists(target)) {
    throw base::Error(base::ErrorCode::kUsage, "is there already: give a new folder, or remove it first", target.string());
  }
  base::StagingFolder staging(target.parent_path() / ("." + target.filename().string() + ".new"));
  session.interrupts.onInterrupt("interrupted; " + target.string() + " was not made", [&] { staging.discard(); });
  fs::create_directory(staging.path() / "recording");
  TerminalProgress progress(session.options);
  const simulate::SimulationSummary summary =
      simulate::simulate({options.script, staging.path() / "recording", static_cast<std::uint64_t>(session.options.seed),
                          session.options.threads, progress.sink()});
  base::syncTree(staging.path());
  session.interrupts.runUninterrupted([&] { base::publishNewFolder(staging.path() / "recording", target); }, "interrupted after the end");
  session.interrupts.onInterrupt("interrupted", nullptr);
  if (session.options.json) {
    nlohmann::ordered_json json;
    json["recording"] = target.string();
    json["frames"] = summary.frames;
    json["lost_frames"] = summary.lost_frames;
    json["duration_s"] = summary.duration_s;
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << summary.frames << " frames, " << base::toFixedText(summary.duration_s, 1) << " s: " << target.string() << '\n';
  }
  return ExitCode::kDone;
}

}  // namespace

void addSimulateCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"simulate", "Records a simulated drive through a home, with the truth beside it.", kExamples});
  const auto options = std::make_shared<SimulateOptions>();
  command.add_option("SCENE", options->script, "HOME/scenes/NAME.toml")->required();
  command.add_option("--out", options->out, "folder of the recording, to be made")->required();
  setAction(command, [options](const Session& session) { return simulateScene(*options, session); });
}

}  // namespace oikos::tools
