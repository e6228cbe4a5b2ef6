// SPDX-License-Identifier: Apache-2.0
// Sources: TUM: "File Formats" and "Intrinsic Camera Calibration of the Kinect",
// https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats (depth images there are registered to colour and already corrected in
// scale). kinect1: the factory default of OpenNI's registered stream, which the same page lists as "ROS default". ICL-NUIM:
// https://www.doc.ic.ac.uk/~ahanda/VaFRIC/codes.html; its fy of -480 tells of a y axis that points up, the images themselves are upright,
// so fy is 480 here.
#include <array>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/camera/calibration.h"

namespace oikos::camera {

namespace {

struct Preset {
  const char* name;
  PinholeCamera color;
  LensDistortion distortion;
  double depth_scale;
};

const std::array<Preset, 5>& presets() {
  static const std::array<Preset, 5> kPresets = {{
      {"kinect1", {640, 480, 525.0, 525.0, 319.5, 239.5}, {}, 1000.0},
      {"tum-fr1", {640, 480, 517.3, 516.5, 318.6, 255.3}, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}, 5000.0},
      {"tum-fr2", {640, 480, 520.9, 521.0, 325.1, 249.7}, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}, 5000.0},
      {"tum-fr3", {640, 480, 535.4, 539.2, 320.1, 247.6}, {}, 5000.0},
      {"icl-nuim", {640, 480, 481.2, 480.0, 319.5, 239.5}, {}, 5000.0},
  }};
  return kPresets;
}

}  // namespace

std::optional<Calibration> findCalibrationPreset(std::string_view name) {
  for (const Preset& preset : presets()) {
    if (name == preset.name) {
      Calibration calibration;
      calibration.color = preset.color;
      calibration.distortion = preset.distortion;
      calibration.depth_scale = preset.depth_scale;
      return calibration;
    }
  }
  return std::nullopt;
}

const std::vector<std::string>& calibrationPresetNames() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) {
      names.emplace_back(preset.name);
    }
    return names;
  }();
  return kNames;
}

Calibration getCalibration(const std::string& preset_or_file) {
  if (const auto preset = findCalibrationPreset(preset_or_file)) {
    return *preset;
  }
  if (!std::filesystem::exists(preset_or_file)) {
    throw base::Error(
        base::ErrorCode::kUsage,
        "neither a file nor a camera preset (nearest preset: " + base::nearestName(preset_or_file, calibrationPresetNames()) + ")",
        preset_or_file);
  }
  return readCalibration(preset_or_file);
}

}  // namespace oikos::camera
