// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/geometry/ply.h"
#include "core/metrics/map_error.h"
#include "core/metrics/trajectory_error.h"
#include "core/recording/trajectory.h"
#include "tools/command.h"
#include "tools/evaluate_answers.h"

namespace oikos::tools {

namespace {

using base::toFixedText;
using Json = nlohmann::ordered_json;

struct Files {
  std::filesystem::path measured;
  std::filesystem::path truth;
};

template <base::NamedEnum Enum>
CLI::Option* addEnumOption(CLI::App& command, const std::string& name, Enum& value, const std::string& description) {
  const auto assign = [&value](const std::string& text) { value = *base::findEnum<Enum>(text); };
  return command.add_option_function<std::string>(name, assign, description)
      ->check(CLI::IsMember(base::enumNames<Enum>()))
      ->default_str(std::string(base::toString(value)));
}

// -- oikos evaluate trajectory

Json relativeJson(const char* delta_name, double delta, const metrics::RelativeError& error) {
  return {{delta_name, delta},
          {"pairs", error.translation_m.count},
          {"translation", statisticsJson(error.translation_m, 1.0, "m")},
          {"rotation", statisticsJson(error.rotation_rad, degrees(1.0), "deg")}};
}

Json alignmentJson(const geometry::RigidAlignment& alignment) {
  const Eigen::Vector3d t = alignment.T_a_b.translation();
  const Eigen::Quaterniond q(alignment.T_a_b.linear());
  return {{"T_truth_estimate", {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}}, {"scale", alignment.scale}};
}

Json toJson(const metrics::TrajectoryError& result, const metrics::TrajectoryErrorConfig& config) {
  Json json = {{"status", base::toString(result.status)},
               {"estimate_poses", result.estimate_count},
               {"truth_poses", result.truth_count},
               {"associated_poses", result.association_count}};
  if (result.absolute_m.count > 0) {
    json["duration_s"] = result.duration_s;
    json["truth_path_m"] = result.truth_path_m;
    json["alignment"] = alignmentJson(result.alignment);
    json["ate"] = statisticsJson(result.absolute_m, 1.0, "m");
    json["motionless_ate_rmse_m"] = result.motionless_absolute_m;
    json["rpe_per_interval"] = relativeJson("interval_s", config.interval_s, result.per_interval);
    json["rpe_per_distance"] = relativeJson("distance_m", config.distance_m, result.per_distance);
  }
  return json;
}

void printRelative(const std::string& name, const metrics::RelativeError& error) {
  if (error.translation_m.count == 0) {
    std::cout << name << "no pair is that long\n";
    return;
  }
  std::cout << name << row(error.translation_m, 100.0, "cm") << "  (" << error.translation_m.count << " pairs)\n"
            << std::string(name.size(), ' ') << row(error.rotation_rad, degrees(1.0), "deg") << '\n';
}

void printText(const metrics::TrajectoryError& result, const metrics::TrajectoryErrorConfig& config) {
  std::cout << "associated    " << result.association_count << " of " << result.estimate_count << " estimated poses, over "
            << toFixedText(result.duration_s, 1) << " s and " << toFixedText(result.truth_path_m, 2) << " m\n"
            << "ATE           " << row(result.absolute_m, 100.0, "cm") << '\n'
            << "motionless    rmse " << toFixedText(100.0 * result.motionless_absolute_m, 2)
            << " cm is the ATE of a camera that never moves\n";
  if (config.scale == geometry::AlignmentScale::kFree) {
    std::cout << "scale         " << base::toText(result.alignment.scale) << " (truth / estimate)\n";
  }
  printRelative("RPE " + toFixedText(config.interval_s, 2) + " s    ", result.per_interval);
  printRelative("RPE " + toFixedText(config.distance_m, 2) + " m    ", result.per_distance);
  if (result.status == metrics::TrajectoryErrorStatus::kUndetermined) {
    std::cout << "note          the positions lie on a line: the rotation about it does not show in the ATE\n";
  }
}

std::string explainFailure(const metrics::TrajectoryError& result, const Files& files) {
  switch (result.status) {
    case metrics::TrajectoryErrorStatus::kEmptyInput:
      return (result.estimate_count == 0 ? files.measured : files.truth).string() + ": holds no pose";
    case metrics::TrajectoryErrorStatus::kNoOverlap:
      return "no estimated stamp is near a true one; are both files on one clock, and is --max-difference wide enough?";
    default:
      return "only " + std::to_string(result.association_count) + " estimated poses have a true one; at least 3 are needed";
  }
}

struct TrajectoryOptions {
  Files files;
  metrics::TrajectoryErrorConfig config;
  bool free_scale = false;
};

ExitCode evaluateTrajectoryFiles(TrajectoryOptions options, const Session& session) {
  metrics::TrajectoryErrorConfig& config = options.config;
  config.scale = options.free_scale ? geometry::AlignmentScale::kFree : geometry::AlignmentScale::kFixed;
  requireValid(config);
  const auto estimate = recording::readTrajectory(options.files.measured);
  const auto truth = recording::readTrajectory(options.files.truth);
  const metrics::TrajectoryError result = metrics::evaluateTrajectory(estimate, truth, config);
  const bool answered = result.absolute_m.count > 0;
  if (session.options.json) {
    std::cout << toJson(result, config).dump(2) << '\n';
  } else if (answered) {
    printText(result, config);
  }
  if (!answered) {
    std::cerr << "oikos: " << explainFailure(result, options.files) << '\n';
  }
  return answered ? ExitCode::kDone : ExitCode::kNoAnswer;
}

void addTrajectoryEvaluation(CLI::App& evaluate) {
  CLI::App& command = addCommand(evaluate, {"trajectory", "Measures the absolute and relative errors of a trajectory.",
                                            "  oikos evaluate trajectory home/map/trajectory.txt drive/groundtruth.txt\n"
                                            "  oikos evaluate trajectory estimate.txt truth.txt --json\n"
                                            "  oikos evaluate trajectory monocular.txt truth.txt --scale\n"
                                            "  oikos evaluate trajectory estimate.txt truth.txt --association nearest --pairs nearest"});
  const auto options = std::make_shared<TrajectoryOptions>();
  metrics::TrajectoryErrorConfig& config = options->config;
  command.add_option("ESTIMATE", options->files.measured, "estimated poses, TUM format: t tx ty tz qx qy qz qw")->required();
  command.add_option("TRUTH", options->files.truth, "true poses, TUM format")->required();
  command.add_flag("--scale", options->free_scale, "align with a free scale, for estimates that have none of their own");
  addEnumOption(command, "--association", config.association, "true pose at an estimated stamp: interpolated, or the nearest as in TUM's");
  addEnumOption(command, "--pairs", config.second_pairs, "pose that ends an interval: first not before its end, or nearest as in TUM's");
  addEnumOption(command, "--path", config.metre_pairs, "whose path measures a distance; estimate is TUM's and evo's rule");
  command.add_option("--max-difference", config.max_association_s, "s; a pose farther from every true stamp is left out")
      ->capture_default_str();
  command.add_option("--interval", config.interval_s, "s; of the relative error by time")->capture_default_str();
  command.add_option("--distance", config.distance_m, "m; of the relative error by path")->capture_default_str();
  setAction(command, [options](const Session& session) { return evaluateTrajectoryFiles(*options, session); });
}

// -- oikos evaluate map

Json distanceJson(const metrics::CloudDistance& distance, const metrics::MapErrorConfig& config) {
  Json json = {{"points", distance.distance_m.count}};
  json.update(statisticsJson(distance.distance_m, 1.0, "m"));
  json["shares"] = {{{"within_m", config.fine_m}, {"share", distance.share_within_fine}},
                    {{"within_m", config.coarse_m}, {"share", distance.share_within_coarse}}};
  return json;
}

void printDistance(const std::string& name, const metrics::CloudDistance& distance, const metrics::MapErrorConfig& config) {
  const auto share = [](double value, double limit_m) {
    return toFixedText(100.0 * value, 1) + " % within " + base::toText(100.0 * limit_m) + " cm";
  };
  std::cout << name << row(distance.distance_m, 100.0, "cm") << '\n'
            << std::string(name.size(), ' ') << share(distance.share_within_fine, config.fine_m) << ", "
            << share(distance.share_within_coarse, config.coarse_m) << "  (" << distance.distance_m.count << " points)\n";
}

struct MapOptions {
  Files files;
  metrics::MapErrorConfig config;
};

ExitCode evaluateMapFiles(MapOptions options, const Session& session) {
  options.config.threads = session.options.threads;
  requireValid(options.config);
  const auto cloud = geometry::readPly(options.files.measured);
  const auto reference = geometry::readPly(options.files.truth);
  const metrics::MapError result = metrics::evaluateMap(cloud.points, reference.points, options.config);
  const bool answered = result.status == metrics::MapErrorStatus::kEvaluated;
  if (session.options.json) {
    Json json = {{"status", base::toString(result.status)}};
    if (answered) {
      json["accuracy"] = distanceJson(result.accuracy, options.config);
      json["completeness"] = distanceJson(result.completeness, options.config);
    }
    std::cout << json.dump(2) << '\n';
  } else if (answered) {
    printDistance("accuracy      ", result.accuracy, options.config);
    printDistance("completeness  ", result.completeness, options.config);
  }
  if (!answered) {
    const bool cloud_empty = result.status == metrics::MapErrorStatus::kEmptyCloud;
    std::cerr << "oikos: " << (cloud_empty ? options.files.measured : options.files.truth).string() << ": holds no points\n";
  }
  return answered ? ExitCode::kDone : ExitCode::kNoAnswer;
}

void addMapEvaluation(CLI::App& evaluate) {
  CLI::App& command = addCommand(evaluate, {"map", "Measures accuracy and completeness of a cloud against a reference in the same frame.",
                                            "  oikos evaluate map home/map/cloud.ply scan.ply\n"
                                            "  oikos evaluate map home/map/mesh.ply scan.ply --fine 0.01 --coarse 0.03 --json"});
  const auto options = std::make_shared<MapOptions>();
  command.add_option("CLOUD", options->files.measured, "the map's points, PLY")->required();
  command.add_option("REFERENCE", options->files.truth, "points that are known to be right, PLY, in the frame of CLOUD")->required();
  command.add_option("--fine", options->config.fine_m, "m; first limit of the shares")->capture_default_str();
  command.add_option("--coarse", options->config.coarse_m, "m; second limit of the shares")->capture_default_str();
  setAction(command, [options](const Session& session) { return evaluateMapFiles(*options, session); });
}

}  // namespace

void addEvaluateCommand(CLI::App& root) {
  CLI::App& evaluate = addCommand(root, {"evaluate", "Measures results against truth with the field's metrics.",
                                         "  oikos evaluate trajectory home/map/trajectory.txt drive/groundtruth.txt\n"
                                         "  oikos evaluate map home/map/cloud.ply scan.ply\n"
                                         "  oikos evaluate states home drive\n"
                                         "  oikos evaluate tags drive --out tags.txt"});
  addTrajectoryEvaluation(evaluate);
  addMapEvaluation(evaluate);
  addTagEvaluation(evaluate);
  addStateEvaluation(evaluate);
}

}  // namespace oikos::tools
