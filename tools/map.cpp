// SPDX-License-Identifier: Apache-2.0
#include "mapping/mapper.h"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/degrees.h"
#include "core/base/number_text.h"
#include "core/recording/recording.h"
#include "mapping/floorplan/plan_file.h"
#include "tools/command.h"
#include "tools/map_home.h"
#include "tools/mount_options.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos map ~/drives/flat-3 --out ~/homes/flat-3\n"
    "  oikos map rgbd_dataset_freiburg1_rpy --camera tum-fr1 --out desk --resolution 0.02\n"
    "  oikos map ~/drives/flat-3 --out flat-3 --robot robot.urdf --base-link base_footprint --camera-link camera_optical\n"
    "  oikos map ~/drives/flat-3 --out flat-3 --floorplan flat-3.svg --floorplan-scale 0.01\n"
    "  oikos map ~/drives/flat-3-tuesday --out ~/homes/flat-3 --extend\n"
    "  oikos map ~/drives/flat-3 --out flat-3 --set volume.every_frame=true --json";

struct MapOptions {
  std::filesystem::path recording;
  std::filesystem::path home;
  std::string camera;
  MountOptions mount;
  std::filesystem::path floor_plan;
  std::optional<double> floor_plan_scale;
  std::string floor_plan_layer;
  std::string features;
  std::string resolution;
  bool every_frame = false;
  bool extend = false;
  std::vector<std::string> settings;
};

void declareOptions(CLI::App& command, MapOptions& options) {
  command.add_option("RECORDING", options.recording, "folder of the drive: TUM RGB-D or 7-Scenes")->required();
  command.add_option("--out", options.home, "folder of the home; its map is made, replaced or extended, the rest is kept")->required();
  auto* const extend = command.add_flag("--extend", options.extend,
                                        "go on with the home's map: the drive finds its place in it, both are optimised together, what has "
                                        "gone is forgotten; by the map's own parameters, where --config and --set do not say otherwise");
  command.add_option("--camera", options.camera,
                     "a camera.toml, or kinect1, tum-fr1, tum-fr2, tum-fr3, icl-nuim; default: the recording's own");
  command.add_option("--features", options.features, "sift or orb");
  command.add_option("--resolution", options.resolution, "edge of a voxel in metres, 0.01 to 1; default 0.05");
  command.add_flag("--every-frame", options.every_frame, "build the volume from every frame, not from keyframes only");
  command.add_option("--set", options.settings, "any parameter, as KEY=VALUE; may be repeated")->allow_extra_args(false);
  auto* const plan = command.add_option("--floorplan", options.floor_plan,
                                        "drawing of the walls, .svg or .dxf: the map is turned to its axes, or refused if it does not fit");
  plan->excludes(extend);
  command.add_option("--floorplan-scale", options.floor_plan_scale, "metres a unit of the drawing; default: what a .dxf says, else 1")
      ->needs(plan)
      ->check(CLI::PositiveNumber);
  command.add_option("--floorplan-layer", options.floor_plan_layer, "the drawing's layer that holds the walls; default: all")->needs(plan);
  declareMountOptions(command, options.mount);
}

/// A map that is extended has parameters already.
std::filesystem::path configFileOf(const MapOptions& options, const GlobalOptions& global) {
  const std::filesystem::path saved = options.home / "map" / "config.toml";
  return global.config.empty() && options.extend && std::filesystem::exists(saved) ? saved : global.config;
}

mapping::MapConfig configOf(const MapOptions& options, const GlobalOptions& global) {
  base::ConfigLayers layers{configFileOf(options, global), {}};
  for (const std::string& text : options.settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  if (!options.features.empty()) {
    layers.settings.push_back({"front_end.features.type", options.features, "--features"});
  }
  if (!options.resolution.empty()) {
    layers.settings.push_back({"volume.occupancy.resolution_m", options.resolution, "--resolution"});
  }
  if (options.every_frame) {
    layers.settings.push_back({"volume.every_frame", "true", "--every-frame"});
  }
  return base::loadConfig<mapping::MapConfig>(layers);
}

std::optional<mapping::PlanTask> planOf(const MapOptions& options) {
  if (options.floor_plan.empty()) {
    return std::nullopt;
  }
  return mapping::PlanTask{mapping::readFloorPlan(options.floor_plan, {options.floor_plan_scale, options.floor_plan_layer}),
                           options.floor_plan.string()};
}

nlohmann::ordered_json changesJson(const mapping::MapResult& result) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < result.changes.size(); ++i) {
    const mapping::Change& change = result.changes[i];
    list.push_back({{"kind", base::toString(change.kind)},
                    {"center_map_m", {change.center_map.x(), change.center_map.y(), change.center_map.z()}},
                    {"size_m", {change.size_m.x(), change.size_m.y(), change.size_m.z()}},
                    {"confidence", change.confidence},
                    {"piece", i < result.explanation.pieces.size() ? result.explanation.pieces[i] : ""}});
  }
  return list;
}

double yaw_deg(const Eigen::Isometry3d& T) {
  return std::atan2(T.linear()(1, 0), T.linear()(0, 0)) / base::kRadPerDeg;
}

nlohmann::ordered_json movedJson(const std::vector<mapping::MovedPieceFacts>& pieces) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const mapping::MovedPieceFacts& piece : pieces) {
    const Eigen::Vector3d p = piece.T_map_after.translation();
    list.push_back({{"id", piece.id}, {"x_m", p.x()}, {"y_m", p.y()}, {"z_m", p.z()}, {"yaw_deg", yaw_deg(piece.T_map_after)}});
  }
  return list;
}

void printChanges(const mapping::MapResult& result) {
  const auto three = [](const Eigen::Vector3d& v, const char* between) {
    return base::toFixedText(v.x(), 2) + between + base::toFixedText(v.y(), 2) + between + base::toFixedText(v.z(), 2);
  };
  for (std::size_t i = 0; i < result.changes.size(); ++i) {
    const mapping::Change& change = result.changes[i];
    const std::string piece = i < result.explanation.pieces.size() ? result.explanation.pieces[i] : "";
    std::cout << (change.kind == mapping::ChangeKind::kNew ? "new: " : "gone: ") << three(change.size_m, " x ") << " m at "
              << three(change.center_map, " ") << (piece.empty() ? "" : " (" + piece + ")") << '\n';
  }
  for (const mapping::MovedPieceFacts& piece : result.explanation.moved) {
    const Eigen::Vector3d p = piece.T_map_after.translation();
    std::cout << piece.id << " moved by " << base::toFixedText((p - piece.T_map_before.translation()).norm(), 2) << " m, to "
              << three(p, " ") << ", yaw " << base::toFixedText(yaw_deg(piece.T_map_after), 0) << " deg\n";
  }
}

struct Summary {
  std::filesystem::path home;
  mapping::MapResult result;
  double elapsed_s = 0.0;

  [[nodiscard]] double framesPerSecond() const { return elapsed_s > 0.0 ? result.frames / elapsed_s : 0.0; }
};

void printJson(const Summary& summary, bool extended) {
  const mapping::MapResult& result = summary.result;
  nlohmann::ordered_json json = {
      {"home", summary.home.string()},
      {"frames", result.frames},
      {"skipped_frames", result.skipped_frames},
      {"lost_frames", result.lost_frames},
      {"carried_frames", result.carried_frames},
      {"keyframes", result.keyframes},
      {"earlier_keyframes", result.earlier_keyframes},
      {"loops", result.loops},
      {"submaps", result.submaps},
      {"floor_found", result.floor_found},
      {"elapsed_s", summary.elapsed_s},
      {"frames_per_s", summary.framesPerSecond()},
  };
  if (result.placement) {
    const mapping::PlanFigures& figures = result.placement->fit.figures;
    json["floor_plan"] = {{"file", result.placement->source},
                          {"residual_rms_m", figures.rms_m},
                          {"plan_walls_seen_share", figures.supported_share},
                          {"upright_surface_on_plan_share", figures.on_plan_share}};
  }
  if (extended) {
    json["changes"] = changesJson(result);
    json["moved_furniture"] = movedJson(result.explanation.moved);
  }
  std::cout << json.dump(2) << '\n';
}

void printText(const Summary& summary) {
  const mapping::MapResult& result = summary.result;
  std::cout << result.frames << " frames in " << base::toFixedText(summary.elapsed_s, 1) << " s ("
            << base::toFixedText(summary.framesPerSecond(), 1) << " per second), " << result.keyframes << " keyframes, " << result.loops
            << " loops\n";
  if (result.earlier_keyframes > 0) {
    std::cout << "the map had " << result.earlier_keyframes << " keyframes, the drive added " << result.keyframes - result.earlier_keyframes
              << '\n';
    printChanges(result);
  }
  if (result.skipped_frames > 0) {
    std::cout << result.skipped_frames << " frames could not be read\n";
  }
  if (result.lost_frames > 0) {
    std::cout << result.lost_frames << " frames were lost and have a pose between those before and after them\n";
  }
  if (result.carried_frames > 0) {
    std::cout << result.carried_frames << " frames could not be followed and were carried on by odometry\n";
  }
  if (result.submaps > 1) {
    std::cout << "the drive fell into " << result.submaps << " parts that no loop has joined\n";
  }
  if (!result.floor_found) {
    std::cout << "no floor was in sight: z = 0 is the first camera, and the grid is unknown\n";
  }
  if (result.placement) {
    const mapping::PlanFigures& figures = result.placement->fit.figures;
    std::cout << "laid onto " << result.placement->source << ": " << base::toFixedText(100.0 * figures.supported_share, 0)
              << " % of its walls were seen, " << base::toFixedText(1000.0 * figures.rms_m, 0) << " mm from their lines\n";
  }
  std::cout << "map: " << (summary.home / "map").string() << "\nreport: " << (summary.home / "map" / "report.html").string() << '\n';
}

Summary buildHome(const MapOptions& options, const Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  const mapping::MapConfig config = configOf(options, session.options);
  std::optional<mapping::PlanTask> plan = planOf(options);
  const auto recording = recording::openRecording(options.recording, {.camera = options.camera});
  const mapping::MapResult result =
      mapIntoHome({*recording, options.home, config, mountOf(options.mount, *recording), std::move(plan), options.extend}, session);
  return {options.home, result, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

}  // namespace

void addMapCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"map", "Builds the metric map of a home from a recorded drive.", kExamples, true});
  const auto options = std::make_shared<MapOptions>();
  declareOptions(command, *options);
  setAction(command, [options](const Session& session) {
    const Summary summary = buildHome(*options, session);
    if (!summary.result.is_placed) {
      std::cerr
          << "oikos: " << options->recording.string() << ": the drive has no place in the map of " << options->home.string()
          << ": too few of its frames show what the map knows; the map is unchanged. Begin the drive where the map has been, or make a "
             "new map without --extend\n";
      return ExitCode::kNoAnswer;
    }
    session.options.json ? printJson(summary, options->extend) : printText(summary);
    return ExitCode::kDone;
  });
}

}  // namespace oikos::tools
