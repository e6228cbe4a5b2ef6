// SPDX-License-Identifier: Apache-2.0
// The knob detector from renders (the user's paper 003, 5.2.1.3).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "recognition/knobs/knob_detector.h"
#include "recognition/knobs/training/panel_shot.h"

namespace oikos::recognition {

struct DetectorTrainingConfig {
  int panels = 4000;            ///< renders; a third of them without a knob
  int negatives_per_panel = 4;  ///< windows by chance, before the first round
  int rounds = 3;               ///< of looking for windows that are wrongly taken for knobs
  int hard_per_panel = 6;       ///< of them in each round, the worst first
  double cost = 1.0;            ///< of a window on the wrong side of the margin (C of the support vector machine)
  double false_alarms = 0.01;   ///< a picture, on panels that were held back: sets the threshold

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("panels", panels);
    visitor("negatives_per_panel", negatives_per_panel);
    visitor("rounds", rounds);
    visitor("hard_per_panel", hard_per_panel);
    visitor("cost", cost);
    visitor("false_alarms", false_alarms);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct TrainingRun {
  std::uint64_t seed = 0;
  int threads = 1;
  base::ProgressSink progress;
};

struct TrainedDetector {
  DetectorModel model;
  int positives = 0;
  int negatives = 0;
  double recall = 0.0;                  ///< on the panels that were held back
  double false_alarms_per_panel = 0.0;  ///< there
};

/// The same for any number of threads. `describe`: what windows are described by; `writeDetector` can only write models of describeByHog.
[[nodiscard]] TrainedDetector trainDetector(const PanelLook& look, const DetectorTrainingConfig& config, const TrainingRun& run,
                                            const CellDescriber& describe = describeByHog);

/// A picture of a panel with none, one or several knobs, of the sizes, tilts and blur that are asked for, and where one is expected.
struct DetectionScene {
  cv::Mat color;
  camera::PinholeCamera camera;
  Eigen::Isometry3d T_camera_panel = Eigen::Isometry3d::Identity();
  FaceView view;  ///< of the face of a knob where the picture was aimed at
  double radius_m = 0.0;
  double height_m = 0.0;
  Panel panel;                                 ///< without its scene
  std::vector<Eigen::Vector2d> centres_patch;  ///< of the knobs' faces
};
[[nodiscard]] DetectionScene drawDetectionScene(const PanelLook& look, int knob_count, Random& random);

}  // namespace oikos::recognition
