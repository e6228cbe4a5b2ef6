// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/degrees.h"
#include "core/base/number_text.h"
#include "core/metrics/error_statistics.h"
#include "core/recording/recording.h"
#include "semantic/history/home_state.h"
#include "tools/command.h"
#include "tools/locate_job.h"
#include "tools/mount_options.h"
#include "tracking/localisation/locate_files.h"

namespace oikos::tools {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using tracking::LocatedPose;
using tracking::PoseSource;

constexpr const char* kExamples =
    "  oikos locate ~/homes/flat-3 ~/drives/flat-3-tuesday --out tuesday.txt\n"
    "  oikos locate homes/demo ~/drives/demo --prior ~/drives/demo/prior.txt --out refined.txt\n"
    "  oikos locate homes/demo ~/drives/demo --from 0,0,0 --object fridge --out refined.txt --json\n"
    "Beside tuesday.txt (TUM, T_map_camera) are tuesday.csv with the 6x6 covariances, and tuesday.before.txt and tuesday.landmarks.csv if "
    "there\n"
    "is furniture to refine by. Exits with 1 if no frame was found.";

struct LocateOptions {
  fs::path home;
  fs::path recording;
  fs::path out;
  fs::path prior;
  std::string from;
  std::string object;
  std::string camera;
  bool no_landmarks = false;
  MountOptions mount;
  std::vector<std::string> settings;
};

void declareOptions(CLI::App& command, LocateOptions& options) {
  command.add_option("HOME", options.home, "the home's folder, with its map, its home.xml, or both")->required();
  command.add_option("RECORDING", options.recording, "folder of the drive: TUM RGB-D or 7-Scenes")->required();
  command.add_option("--out", options.out, "TUM file of the poses found, to be made or replaced; others stand beside it")->required();
  auto* const prior = command.add_option("--prior", options.prior, "TUM file, T_map_base: where something else believes the robot to be");
  auto* const from = command.add_option("--from", options.from, "where the robot was at the first frame: X,Y,YAW (m, degrees)");
  prior->excludes(from);
  auto* const object = command.add_option("--object", options.object, "refine by this one piece of furniture");
  auto* const none = command.add_flag("--no-landmarks", options.no_landmarks, "find frames in the map only");
  object->excludes(none);
  command.add_option("--camera", options.camera,
                     "a camera.toml, or kinect1, tum-fr1, tum-fr2, tum-fr3, icl-nuim; default: the recording's own");
  declareMountOptions(command, options.mount);
  command.add_option("--set", options.settings, "any parameter, as KEY=VALUE; may be repeated")->allow_extra_args(false);
}

/// How often a piece was in view, and what it was taken for.
using Verdicts = std::map<std::string, std::map<registration::LandmarkVerdict, int>>;

struct Summary {
  int frames = 0;
  int unreadable = 0;
  int found = 0;
  int relocalised = 0;
  int tracked = 0;
  int refined = 0;
  int inconsistent = 0;
  int ambiguous = 0;
  metrics::ErrorStatistics correction_m;
  metrics::ErrorStatistics correction_rad;
  Verdicts landmarks;
  double opening_s = 0.0;
  double elapsed_s = 0.0;
};

Summary summarise(const Located& located) {
  Summary summary;
  summary.frames = static_cast<int>(located.poses.size());
  summary.unreadable = located.unreadable;
  summary.opening_s = located.opening_s;
  std::vector<double> moved_m;
  std::vector<double> moved_rad;
  for (const LocatedPose& pose : located.poses) {
    summary.found += pose.isFound() ? 1 : 0;
    summary.relocalised += pose.in_map.status == mapping::LocateStatus::kRelocalised ? 1 : 0;
    summary.tracked += pose.in_map.status == mapping::LocateStatus::kTracked ? 1 : 0;
    if (!pose.landmarks) {
      continue;
    }
    summary.inconsistent += pose.landmarks->status == registration::RefinementStatus::kInconsistent ? 1 : 0;
    summary.ambiguous += pose.landmarks->status == registration::RefinementStatus::kAmbiguous ? 1 : 0;
    if (pose.source == PoseSource::kLandmarks) {
      ++summary.refined;
      moved_m.push_back(pose.landmarks->moved_m);
      moved_rad.push_back(pose.landmarks->moved_rad);
    }
    for (const registration::LandmarkContribution& piece : pose.landmarks->landmarks) {
      ++summary.landmarks[piece.id][piece.verdict];
    }
  }
  summary.correction_m = metrics::statisticsOf(std::move(moved_m));
  summary.correction_rad = metrics::statisticsOf(std::move(moved_rad));
  return summary;
}

void printJson(const Summary& summary, const fs::path& out) {
  Json landmarks = Json::array();
  for (const auto& [id, verdicts] : summary.landmarks) {
    Json piece = {{"id", id}};
    for (const auto& [verdict, frames] : verdicts) {
      piece[std::string(base::toString(verdict)) + "_frames"] = frames;
    }
    landmarks.push_back(std::move(piece));
  }
  const Json json = {{"trajectory", out.string()},
                     {"frames", summary.frames},
                     {"skipped_frames", summary.unreadable},
                     {"found", summary.found},
                     {"relocalised", summary.relocalised},
                     {"tracked", summary.tracked},
                     {"refined", summary.refined},
                     {"inconsistent", summary.inconsistent},
                     {"ambiguous", summary.ambiguous},
                     {"median_correction_m", summary.correction_m.median},
                     {"median_correction_deg", summary.correction_rad.median / base::kRadPerDeg},
                     {"landmarks", landmarks},
                     {"opening_s", summary.opening_s},
                     {"elapsed_s", summary.elapsed_s}};
  std::cout << json.dump(2) << '\n';
}

void printText(const Summary& summary, const fs::path& out) {
  using base::toFixedText;
  std::cout << summary.found << " of " << summary.frames << " frames found in " << toFixedText(summary.elapsed_s, 1)
            << " s: " << summary.relocalised << " relocalised in the map, " << summary.tracked << " tracked, " << summary.refined
            << " refined by landmarks\n";
  if (summary.unreadable > 0) {
    std::cout << summary.unreadable << " frames could not be read\n";
  }
  if (summary.refined > 0) {
    std::cout << "landmarks moved the robot by " << toFixedText(100.0 * summary.correction_m.median, 1) << " cm and "
              << toFixedText(summary.correction_rad.median / base::kRadPerDeg, 2) << " deg (median)\n";
  }
  if (summary.inconsistent > 0) {
    std::cout << "in " << summary.inconsistent << " frames the furniture contradicts itself or the prior, and was not relied on\n";
  }
  if (summary.ambiguous > 0) {
    std::cout << "in " << summary.ambiguous << " frames the furniture fits in more than one place, and was not relied on\n";
  }
  for (const auto& [id, verdicts] : summary.landmarks) {
    const auto moved = verdicts.find(registration::LandmarkVerdict::kMoved);
    if (moved != verdicts.end()) {
      std::cout << id << " is not where it is believed to be in " << moved->second << " frames\n";
    }
  }
  if (summary.found > 0) {
    std::cout << "trajectory: " << out.string() << '\n';
  }
}

/// As when the map was made, where nothing else is said.
tracking::LocaliseConfig configOf(const LocateOptions& options, const GlobalOptions& global) {
  tracking::LocaliseConfig config = localiseConfigOf(options.home, global.threads);
  base::ConfigLayers layers{global.config, {}};
  for (const std::string& text : options.settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  const base::ConfigOrigins origins = base::assignFields(base::listFields(config), layers);
  base::throwIfInvalid(base::validateConfig(config), origins);
  return config;
}

ExitCode locate(const LocateOptions& options, const Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  const auto recording = recording::openRecording(options.recording, {.camera = options.camera});
  const bool has_home = fs::exists(options.home / "home.xml") || !options.object.empty();
  std::optional<semantic::Home> known;
  if (has_home && !options.no_landmarks) {
    known = semantic::loadHome(options.home);
  }
  LocateJob job{*recording, options.home, configOf(options, session.options), mountOf(options.mount, *recording), options.prior};
  job.known = known ? &*known : nullptr;
  job.object = options.object;
  job.seed = session.options.seed;
  if (!options.from.empty()) {
    job.from = parseFloorPlace(options.from, "--from");
  }
  const Located located = locateRecording(job, session);
  tracking::writeLocated(located.poses, job.T_base_camera, options.out);
  Summary summary = summarise(located);
  summary.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  session.options.json ? printJson(summary, options.out) : printText(summary, options.out);
  return summary.found > 0 ? ExitCode::kDone : ExitCode::kNoAnswer;
}

}  // namespace

void addLocateCommand(CLI::App& root) {
  CLI::App& command =
      addCommand(root, {"locate", "Finds where each frame of a drive was, in the map and by the furniture.", kExamples, true});
  const auto options = std::make_shared<LocateOptions>();
  declareOptions(command, *options);
  setAction(command, [options](const Session& session) { return locate(*options, session); });
}

}  // namespace oikos::tools
