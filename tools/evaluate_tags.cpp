// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "core/camera/calibration.h"
#include "core/metrics/base_pose_error.h"
#include "core/tags/tag_path.h"
#include "tools/command.h"
#include "tools/evaluate_answers.h"
#include "tools/terminal_progress.h"

namespace oikos::tools {

namespace {

namespace fs = std::filesystem;
using base::toFixedText;
using Json = nlohmann::ordered_json;
using tags::TagPicture;
using tags::TagPictureStatus;

constexpr double kNear_m = 4.0;  ///< the errors within it are given apart

struct TagOptions {
  fs::path recording;
  fs::path out;  ///< empty: the path is not written
  tags::TagPathConfig config;
};

struct TagErrors {
  metrics::BasePoseError all;
  metrics::BasePoseError near;
};

struct TagAnswer {
  std::vector<TagPicture> pictures;
  recording::Trajectory path;
  std::optional<TagErrors> errors;  ///< nothing: the recording has no truth

  [[nodiscard]] int count(TagPictureStatus status) const {
    return static_cast<int>(std::count_if(pictures.begin(), pictures.end(), [&](const auto& picture) { return picture.status == status; }));
  }
};

fs::path folderOf(const TagOptions& options) {
  const fs::path folder = options.recording / "ceiling";
  if (!fs::exists(options.recording)) {
    throw base::Error(base::ErrorCode::kIo, "there is no such recording", options.recording.string());
  }
  if (!fs::is_directory(folder)) {
    throw base::Error(base::ErrorCode::kInput,
                      "has no folder 'ceiling' with the pictures of a camera that watches the robot (rgb.txt, camera.toml, tags.toml); "
                      "oikos simulate records one if the scene says [ceiling_camera] position_m",
                      options.recording.string());
  }
  return folder;
}

/// The true path of the base by that of the robot's camera.
recording::Trajectory readTruth(const fs::path& recording) {
  const fs::path file = recording / "camera.toml";
  const std::optional<Eigen::Isometry3d> T_base_camera = camera::readCalibration(file).T_base_camera;
  if (!T_base_camera) {
    throw base::Error(
        base::ErrorCode::kInput,
        "T_base_camera: is missing: the mount of the camera whose true path is in groundtruth.txt; without it the path of the "
        "robot is not known",
        file.string());
  }
  recording::Trajectory truth = recording::readTrajectory(recording / "groundtruth.txt");
  for (recording::StampedPose& pose : truth) {
    pose.T_map_camera = pose.T_map_camera * T_base_camera->inverse();
  }
  return truth;
}

std::vector<metrics::PosePair> pairsOf(const recording::Trajectory& path, const recording::Trajectory& truth) {
  constexpr std::int64_t kMaxDifference_ns = 20'000'000;
  return metrics::associate(path, truth, metrics::Association::kInterpolated, kMaxDifference_ns);
}

TagErrors errorsOf(const TagAnswer& answer, const recording::Trajectory& truth) {
  std::vector<TagPicture> near;
  std::copy_if(answer.pictures.begin(), answer.pictures.end(), std::back_inserter(near),
               [](const TagPicture& picture) { return picture.distance_m <= kNear_m; });
  return {evaluateBasePoses(pairsOf(answer.path, truth)), evaluateBasePoses(pairsOf(keptPath(near), truth))};
}

Json errorJson(const metrics::BasePoseError& error) {
  return {{"poses", error.position_m.count},
          {"position", statisticsJson(error.position_m, 1.0, "m")},
          {"rotation", statisticsJson(error.rotation_rad, degrees(1.0), "deg")},
          {"x", statisticsJson(error.x_m, 1.0, "m")},
          {"y", statisticsJson(error.y_m, 1.0, "m")},
          {"yaw", statisticsJson(error.yaw_rad, degrees(1.0), "deg")}};
}

Json toJson(const TagAnswer& answer) {
  Json json = {{"pictures", answer.pictures.size()}};
  for (const TagPictureStatus status :
       {TagPictureStatus::kKept, TagPictureStatus::kTagsMissing, TagPictureStatus::kTooFar, TagPictureStatus::kBadFit}) {
    json[std::string(base::toString(status))] = answer.count(status);
  }
  if (answer.errors) {
    json["error"] = errorJson(answer.errors->all);
    json["error_near"] = errorJson(answer.errors->near);
    json["error_near"]["within_m"] = kNear_m;
  }
  return json;
}

void printError(const std::string& name, const metrics::BasePoseError& error) {
  if (error.position_m.count == 0) {
    std::cout << name << "no pose\n";
    return;
  }
  const std::string indent(name.size(), ' ');
  std::cout << name << "position  " << row(error.position_m, 100.0, "cm") << "  (" << error.position_m.count << " poses)\n"
            << indent << "rotation  " << row(error.rotation_rad, degrees(1.0), "deg") << '\n'
            << indent << "mean of x " << toFixedText(100.0 * error.x_m.mean, 2) << " cm, y " << toFixedText(100.0 * error.y_m.mean, 2)
            << " cm, yaw " << toFixedText(degrees(error.yaw_rad.mean), 2) << " deg\n";
}

void printText(const TagAnswer& answer, const tags::TagPathConfig& config) {
  std::cout << "pictures      " << answer.pictures.size() << ", kept " << answer.count(TagPictureStatus::kKept)
            << ": not all tags found in " << answer.count(TagPictureStatus::kTagsMissing) << ", farther than "
            << base::toText(config.max_distance_m) << " m in " << answer.count(TagPictureStatus::kTooFar)
            << ", tags that do not lie as on the board in " << answer.count(TagPictureStatus::kBadFit) << '\n';
  if (answer.errors) {
    printError("error         ", answer.errors->all);
    printError("within " + toFixedText(kNear_m, 0) + " m    ", answer.errors->near);
  }
}

ExitCode evaluateTags(TagOptions options, const Session& session) {
  options.config.threads = session.options.threads;
  requireValid(options.config);
  TerminalProgress progress(session.options);
  TagAnswer answer;
  answer.pictures = readTagPath(folderOf(options), options.config, progress.sink());
  answer.path = keptPath(answer.pictures);
  if (fs::exists(options.recording / "groundtruth.txt")) {
    answer.errors = errorsOf(answer, readTruth(options.recording));
  }
  if (!options.out.empty() && !answer.path.empty()) {
    writeTrajectory(answer.path, options.out);
  }
  if (session.options.json) {
    std::cout << toJson(answer).dump(2) << '\n';
  } else {
    printText(answer, options.config);
  }
  if (answer.path.empty()) {
    std::cerr << "oikos: no picture shows all tags of the board near enough; no path\n";
  } else if (answer.errors && answer.errors->all.position_m.count == 0) {
    std::cerr << "oikos: no picture was taken at a time that groundtruth.txt knows; are both on one clock?\n";
  }
  return answer.path.empty() ? ExitCode::kNoAnswer : ExitCode::kDone;
}

}  // namespace

void addTagEvaluation(CLI::App& evaluate) {
  CLI::App& command = addCommand(evaluate, {"tags", "Finds the robot's path by a still camera that sees a board of AprilTags on the robot.",
                                            "  oikos evaluate tags drive --out tags.txt\n"
                                            "  oikos evaluate tags drive --max-distance 4 --json"});
  const auto options = std::make_shared<TagOptions>();
  command.add_option("RECORDING", options->recording, "its folder 'ceiling' has the pictures; groundtruth.txt, if there, is compared with")
      ->required();
  command.add_option("--out", options->out, "where to write the path, T_map_base, TUM format; default: nowhere");
  command.add_option("--max-distance", options->config.max_distance_m, "m; a picture with the board farther away is left out")
      ->capture_default_str();
  command
      .add_option("--max-rms", options->config.max_rms_px, "px; a picture whose tags are farther from where the board has them is left out")
      ->capture_default_str();
  setAction(command, [options](const Session& session) { return evaluateTags(*options, session); });
}

}  // namespace oikos::tools
