// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/rfc3339.h"
#include "tools/command.h"
#include "tools/interrupts.h"
#include "tools/locate_job.h"
#include "tools/track_answers.h"
#include "tools/track_batch.h"

namespace oikos::tools {

namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples =
    "  oikos track ~/homes/flat-3 ~/drives/monday ~/drives/tuesday\n"
    "  oikos track ~/homes/flat-3 ~/drives/monday --dry-run --json\n"
    "  oikos track ~/homes/flat-3 ~/drives/now --object fridge --dry-run\n"
    "  oikos track ~/homes/flat-3 ~/drives/* --jobs 2\n"
    "A recording counts once, whatever its folder is called; what was interrupted goes on where it stopped. oikos revert takes a "
    "recording\n"
    "back. Exits with 1 if no frame of any recording was found; with the code of the first one that failed, when the others are done.";

struct TrackOptions {
  TrackTask task;
  std::string from;
  std::string start;
  std::vector<std::string> settings;
};

void declareOptions(CLI::App& command, TrackOptions& options) {
  TrackTask& task = options.task;
  command.add_option("HOME", task.home, "the home's folder, with its map")->required();
  command.add_option("RECORDING", task.recordings, "folders of drives: TUM RGB-D or 7-Scenes")->required();
  command.add_flag("--dry-run", task.is_dry, "say what would be written, and write nothing");
  command.add_flag("--changes", task.has_changes,
                   "also say what is new or gone against the map and is not explained otherwise; recalls the whole map");
  command.add_option("--object", task.object, "read this one piece of furniture");
  command.add_option("--jobs", task.jobs, "recordings that are read at the same time; the events do not depend on it")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command.add_option("--start", options.start,
                     "when recordings were made whose camera.toml does not say it, RFC 3339: 2026-03-02T08:00:00Z");
  auto* const prior = command.add_option("--prior", task.prior, "TUM file, T_map_base: where something else believes the robot to be");
  auto* const from = command.add_option("--from", options.from, "where the robot was at the first frame: X,Y,YAW (m, degrees)");
  prior->excludes(from);
  command.add_option("--camera", task.camera,
                     "a camera.toml, or kinect1, tum-fr1, tum-fr2, tum-fr3, icl-nuim; default: the recording's own");
  declareMountOptions(command, task.mount);
  command.add_option("--set", options.settings, "any parameter, as KEY=VALUE; may be repeated")->allow_extra_args(false);
}

TrackConfig configOf(const TrackOptions& options, const GlobalOptions& global) {
  TrackConfig config;
  config.locate = localiseConfigOf(options.task.home, global.threads);
  base::ConfigLayers layers{global.config, {}};
  for (const std::string& text : options.settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  const base::ConfigOrigins origins = base::assignFields(base::listFields(config), layers);
  base::throwIfInvalid(base::validateConfig(config), origins);
  return config;
}

TrackTask taskOf(const TrackOptions& options, const Session& session) {
  TrackTask task = options.task;
  task.config = configOf(options, session.options);
  if (!options.start.empty()) {
    task.start_ns = base::parseRfc3339Ns(options.start);
    if (!task.start_ns) {
      throw base::Error(base::ErrorCode::kUsage, "'" + options.start + "' is no time such as 2026-03-02T08:00:00Z", "--start");
    }
  }
  if (!options.from.empty()) {
    task.from = parseFloorPlace(options.from, "--from");
  }
  if (task.recordings.size() > 1 && (task.from || !task.prior.empty())) {
    throw base::Error(base::ErrorCode::kUsage, "--prior and --from are of one recording; several were given");
  }
  return task;
}

ExitCode codeOf(const TrackOutcome& outcome) {
  bool has_found = false;
  for (const TrackedRecording& recording : outcome.recordings) {
    if (recording.status == TrackStatus::kFailed) {
      return recording.code;
    }
    has_found |= recording.status != TrackStatus::kNotFound;
  }
  return has_found ? ExitCode::kDone : ExitCode::kNoAnswer;
}

ExitCode track(const TrackOptions& options, const Session& session) {
  const TrackTask task = taskOf(options, session);
  session.interrupts.onInterrupt("interrupted; nothing was written", nullptr);
  const auto done = [&](const TrackedRecording& recording) {
    if (recording.status == TrackStatus::kFailed) {
      std::cerr << "oikos: " << recording.problem << '\n';
    } else if (!session.options.json) {
      printText(recording, task);
    }
  };
  const TrackOutcome outcome = trackRecordings(task, session, done);
  if (session.options.json) {
    std::cout << toJson(outcome, task).dump(2) << '\n';
  }
  if (!outcome.checkpoint_problem.empty()) {
    std::cerr << "oikos: home.xml is left to be written: " << outcome.checkpoint_problem << '\n';
  }
  return codeOf(outcome);
}

}  // namespace

void addTrackCommand(CLI::App& root) {
  CLI::App& command =
      addCommand(root, {"track", "Reads doors, drawers, knobs and small objects in recorded drives and notes in the home what has changed.",
                        kExamples, true});
  const auto options = std::make_shared<TrackOptions>();
  declareOptions(command, *options);
  setAction(command, [options](const Session& session) { return track(*options, session); });
}

}  // namespace oikos::tools
