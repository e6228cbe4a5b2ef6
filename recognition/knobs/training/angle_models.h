// SPDX-License-Identifier: Apache-2.0
// The angle of a knob learnt from renders, as the user's paper 003 has it (5.2.1.4): a random forest over 36 classes, and a support vector
// regression. They know no knob in particular; KnobReader, which does, is measured against them.
#pragma once

#include <memory>
#include <vector>

#include "core/base/enum_table.h"
#include "recognition/knobs/face_patch.h"
#include "recognition/knobs/training/detector_training.h"

namespace oikos::recognition {

struct AngleTrainingConfig {
  int renders = 6000;
  int trees = 100;
  int classes = 36;
  double svr_cost = 0.1;      ///< C
  double svr_epsilon = 0.05;  ///< half the width of the tube, in radians or of sine and cosine

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("renders", renders);
    visitor("trees", trees);
    visitor("classes", classes);
    visitor("svr_cost", svr_cost);
    visitor("svr_epsilon", svr_epsilon);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class AngleMethod {
  kForest,       ///< the class of most trees
  kSvr,          ///< the angle itself: has an end where the circle has none
  kPeriodicSvr,  ///< its sine and cosine
};
constexpr auto enumTable(AngleMethod) {
  return std::to_array<base::EnumName<AngleMethod>>(
      {{AngleMethod::kForest, "forest"}, {AngleMethod::kSvr, "svr"}, {AngleMethod::kPeriodicSvr, "periodic svr"}});
}

/// Trained models. Immutable, so thread-safe.
class AngleModels {
 public:
  ~AngleModels();
  AngleModels(AngleModels&&) noexcept;
  AngleModels& operator=(AngleModels&&) noexcept;

  /// The angle of the mark about the face's z, from its x; [0, 2 pi). `image.view` and `centre_patch` say where the face is.
  [[nodiscard]] double predict(AngleMethod method, const FaceImage& image, const Eigen::Vector2d& centre_patch) const;

 private:
  friend AngleModels trainAngles(const PanelLook& look, const AngleTrainingConfig& config, const TrainingRun& run);
  struct Impl;
  explicit AngleModels(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The same for any number of threads.
[[nodiscard]] AngleModels trainAngles(const PanelLook& look, const AngleTrainingConfig& config, const TrainingRun& run);

}  // namespace oikos::recognition
