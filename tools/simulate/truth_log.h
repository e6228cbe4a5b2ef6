// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/camera/calibration.h"
#include "core/render/scene.h"
#include "tools/simulate/shooter.h"
#include "tools/simulate/world.h"

namespace oikos::simulate {

/// What was really there, for evaluation: `states.csv` (`t,id,value,unit`), `objects.jsonl`, a line a frame, and images of parts.
class TruthLog {
 public:
  explicit TruthLog(const camera::Calibration& calibration) : camera_(calibration.color), distortion_(calibration.distortion) {}

  /// Every joint and knob whose value is not what was noted last; all of them the first time.
  void noteStates(const semantic::Home& home, double time_s);
  /// Which small objects are in the picture, where, and how much of each is not hidden.
  void noteObjects(const World& world, const Shot& shot, double time_s);
  void write(const std::filesystem::path& folder) const;
  /// `parts.csv` (`number,id,part`): what the numbers in the images of parts mean.
  static void writePartNames(const World& world, const std::filesystem::path& folder);
  /// The picture's parts by their numbers, from 1; 0: nothing is there.
  static void writeParts(const Shot& shot, const std::filesystem::path& file);

 private:
  [[nodiscard]] int pixelsAlone(const render::ScenePart& part, const Shot& shot);

  camera::PinholeCamera camera_;
  camera::LensDistortion distortion_;
  std::map<std::string, std::string> last_values_;
  std::map<const model::TriangleMesh*, render::Scene> alone_;  ///< each with one mesh
  std::string states_ = "t,id,value,unit\n";
  std::string objects_;
};

}  // namespace oikos::simulate
