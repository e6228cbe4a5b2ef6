// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/training/detector_training.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <opencv2/ml.hpp>

#include "core/base/config.h"
#include "core/base/config_rules.h"
#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace oikos::recognition {

namespace {

constexpr double kMatch = 0.5;  // in radii: a detection nearer than that is of the knob
constexpr double kApart = 0.8;  // one farther away is not, and no better window is there to suppress it
constexpr double kTrainSearch_m = 0.04;
constexpr double kHeldBack = 0.2;  // of the panels

/// A scene as training keeps it.
struct Example {
  cv::Mat color;
  camera::PinholeCamera camera;
  FaceView view;
  double radius_m = 0.0;
  std::vector<Eigen::Vector2d> centres_patch;

  [[nodiscard]] FaceImage image() const { return {color, camera, view, radius_m}; }
  [[nodiscard]] bool isKnob(const Eigen::Vector2d& point_patch, double radii) const {
    return std::any_of(centres_patch.begin(), centres_patch.end(),
                       [&](const Eigen::Vector2d& centre) { return (centre - point_patch).norm() < radii * radius_m; });
  }
};

struct Window {
  std::vector<float> descriptor;
  bool is_knob = false;
};

Example drawExample(const PanelLook& look, std::uint64_t seed, int number) {
  Random random(seed, static_cast<std::uint64_t>(number));
  const int knobs = number % 3 == 0 ? 0 : number % 3 == 1 ? 1 : 2 + random.below(3);
  const DetectionScene scene = drawDetectionScene(look, knobs, random);
  return {scene.color, scene.camera, scene.view, scene.radius_m, scene.centres_patch};
}

bool isInPicture(const Example& example, const Eigen::Vector2d& point_patch) {
  return example.camera.contains(projectPatch(example.view, example.camera, point_patch), 2.0);
}

std::vector<Window> firstWindows(const Example& example, const DetectorTrainingConfig& config, const CellDescriber& describe,
                                 Random& random) {
  std::vector<Window> windows;
  const auto add = [&](const Eigen::Vector2d& centre_patch, double scale, bool is_knob) {
    FaceImage image = example.image();
    image.radius_m *= scale;
    windows.push_back({describeWindow(image, centre_patch, describe), is_knob});
  };
  for (const Eigen::Vector2d& centre : example.centres_patch) {
    if (isInPicture(example, centre)) {
      constexpr double kJitter = 0.06;  // in radii; windows are half a cell apart, a tenth of that
      const Eigen::Vector2d jitter(random.normal(), random.normal());
      add(centre + kJitter * example.radius_m * jitter, random.between(0.95, 1.06), true);
    }
  }
  for (int i = 0; i < config.negatives_per_panel; ++i) {
    const Eigen::Vector2d anywhere(random.between(-kTrainSearch_m, kTrainSearch_m), random.between(-kTrainSearch_m, kTrainSearch_m));
    if (isInPicture(example, anywhere) && !example.isKnob(anywhere, kApart)) {
      add(anywhere, random.between(0.85, 1.18), false);
    }
  }
  return windows;
}

/// What the model takes for knobs and is none.
std::vector<Window> hardWindows(const Example& example, const DetectorModel& model, const DetectorTrainingConfig& config) {
  DetectorConfig loose;
  loose.search_m = kTrainSearch_m;
  loose.min_score = -0.8;
  std::vector<Window> windows;
  for (const KnobDetection& found : detectKnobs(example.image(), model, loose)) {
    if (!example.isKnob(found.centre_patch, kApart) && static_cast<int>(windows.size()) < config.hard_per_panel) {
      FaceImage image = example.image();
      image.radius_m = found.radius_m;
      windows.push_back({describeWindow(image, found.centre_patch, model.describe), false});
    }
  }
  return windows;
}

DetectorModel fitSvm(const std::vector<Window>& windows, double cost, const CellDescriber& describe) {
  const auto numbers = static_cast<int>(windows.front().descriptor.size());
  cv::Mat samples(static_cast<int>(windows.size()), numbers, CV_32FC1);
  cv::Mat labels(static_cast<int>(windows.size()), 1, CV_32SC1);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    std::copy(windows[i].descriptor.begin(), windows[i].descriptor.end(), samples.ptr<float>(static_cast<int>(i)));
    labels.at<int>(static_cast<int>(i)) = windows[i].is_knob ? 1 : -1;
  }
  const auto svm = cv::ml::SVM::create();
  svm->setType(cv::ml::SVM::C_SVC);
  svm->setKernel(cv::ml::SVM::LINEAR);
  svm->setC(cost);
  svm->setTermCriteria({cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20000, 1e-3});
  svm->train(cv::ml::TrainData::create(samples, cv::ml::ROW_SAMPLE, labels));
  cv::Mat alpha;
  cv::Mat indices;
  const double rho = svm->getDecisionFunction(0, alpha, indices);
  const cv::Mat weights = svm->getSupportVectors();  // a linear machine keeps one
  DetectorModel model;
  // OpenCV's decision function is positive for the lesser label.
  for (int i = 0; i < numbers; ++i) {
    model.weights.push_back(-weights.at<float>(0, i));
  }
  model.bias = static_cast<float>(rho);
  model.describe = describe;
  return model;
}

/// The scores of what is found and of what is no knob on panels that were not trained on.
struct HeldBack {
  std::vector<double> knobs;   ///< the best score near each knob; -infinity: none
  std::vector<double> alarms;  ///< falling
  int panels = 0;
};

HeldBack scoreHeldBack(const std::vector<Example>& examples, std::size_t first, const DetectorModel& model, int threads) {
  std::vector<HeldBack> slots(examples.size() - first);
  base::parallelFor(static_cast<int>(slots.size()), threads, [&](int i) {
    const Example& example = examples[first + static_cast<std::size_t>(i)];
    HeldBack& slot = slots[static_cast<std::size_t>(i)];
    DetectorConfig loose;
    loose.search_m = kTrainSearch_m;
    loose.min_score = -1.0;
    const std::vector<KnobDetection> found = detectKnobs(example.image(), model, loose);
    for (const Eigen::Vector2d& centre : example.centres_patch) {
      if (centre.norm() > 0.8 * kTrainSearch_m || !isInPicture(example, centre)) {
        continue;
      }
      const auto of = std::find_if(found.begin(), found.end(),
                                   [&](const auto& d) { return (d.centre_patch - centre).norm() < kMatch * example.radius_m; });
      slot.knobs.push_back(of == found.end() ? -1e9 : of->score);
    }
    for (const KnobDetection& detection : found) {
      if (!example.isKnob(detection.centre_patch, kMatch)) {
        slot.alarms.push_back(detection.score);
      }
    }
  });
  HeldBack all;
  all.panels = static_cast<int>(slots.size());
  for (const HeldBack& slot : slots) {
    all.knobs.insert(all.knobs.end(), slot.knobs.begin(), slot.knobs.end());
    all.alarms.insert(all.alarms.end(), slot.alarms.begin(), slot.alarms.end());
  }
  std::sort(all.alarms.begin(), all.alarms.end(), std::greater<>());
  return all;
}

/// Moves the threshold to where so many false alarms are left.
void setThreshold(const HeldBack& scores, const DetectorTrainingConfig& config, TrainedDetector& trained) {
  const auto allowed = static_cast<std::size_t>(config.false_alarms * scores.panels);
  const double threshold = allowed < scores.alarms.size() ? scores.alarms[allowed] : 0.0;
  trained.model.threshold = static_cast<float>(threshold);
  const auto hits = std::count_if(scores.knobs.begin(), scores.knobs.end(), [&](double score) { return score > threshold; });
  trained.recall = scores.knobs.empty() ? 0.0 : static_cast<double>(hits) / static_cast<double>(scores.knobs.size());
  const auto alarms = std::count_if(scores.alarms.begin(), scores.alarms.end(), [&](double score) { return score > threshold; });
  trained.false_alarms_per_panel = static_cast<double>(alarms) / std::max(1, scores.panels);
}

}  // namespace

std::vector<std::string> DetectorTrainingConfig::validate() const {
  return base::ConfigRules()
      .between("panels", panels, 10, 36000)
      .between("negatives_per_panel", negatives_per_panel, 1, 100)
      .between("rounds", rounds, 0, 10)
      .between("hard_per_panel", hard_per_panel, 1, 100)
      .greater("cost", cost, 0.0)
      .between("false_alarms", false_alarms, 0.0, 1.0)
      .messages();
}

DetectionScene drawDetectionScene(const PanelLook& look, int knob_count, Random& random) {
  DetectionScene scene;
  Panel panel = drawPanel(look, {.knob_count = knob_count, .knob = {}}, random);
  ShotOrder order;
  order.diameter_px = 24.0 * std::pow(5.0, random.between(0.0, 1.0));
  order.tilt_rad = random.between(0.0, 50.0) * base::kRadPerDeg;
  order.azimuth_rad = random.between(0.0, 2.0 * std::numbers::pi);
  order.roll_rad = random.normal() * 0.1;
  order.target_panel = {random.between(-0.2, 0.2), random.between(-0.08, 0.08)};
  scene.radius_m = random.between(0.013, 0.026);
  scene.height_m = scene.radius_m * random.between(0.55, 1.2);
  if (!panel.knobs.empty()) {
    const DrawnKnob& knob = random.of(panel.knobs);
    order.target_panel = knob.position_panel;
    scene.radius_m = knob.size.radius_m;
    scene.height_m = knob.size.height_m;
  }
  order.radius_m = scene.radius_m;
  const int side = std::clamp(static_cast<int>(5.0 * order.diameter_px), 140, 420);
  order.width_px = side;
  order.height_px = side * 3 / 4;
  order.offset_px = order.diameter_px * 0.8;
  const PanelShot shot = shootPanel(panel, order, random);
  scene.color = shot.color;
  scene.camera = shot.camera;
  scene.T_camera_panel = shot.T_camera_panel;
  // Where a knob is believed to be: somewhat beside the one that was aimed at.
  constexpr double kBeliefSigma_m = 0.004;
  const Eigen::Vector2d believed = order.target_panel + kBeliefSigma_m * Eigen::Vector2d(random.normal(), random.normal());
  const Eigen::Isometry3d T_panel_face(Eigen::Translation3d(believed.x(), believed.y(), scene.height_m));
  scene.view = viewFace(shot.T_camera_panel * T_panel_face, shot.camera);
  const double cosine = std::cos(scene.view.azimuth_rad);
  const double sine = std::sin(scene.view.azimuth_rad);
  for (const DrawnKnob& knob : panel.knobs) {
    const Eigen::Vector2d off = knob.position_panel - believed;
    scene.centres_patch.emplace_back(-sine * off.x() + cosine * off.y(), cosine * off.x() + sine * off.y());
  }
  panel.scene.reset();
  scene.panel = std::move(panel);
  return scene;
}

TrainedDetector trainDetector(const PanelLook& look, const DetectorTrainingConfig& config, const TrainingRun& run,
                              const CellDescriber& describe) {
  OIKOS_CHECK(base::validateConfig(config).empty());
  std::vector<Example> examples(static_cast<std::size_t>(config.panels));
  std::vector<std::vector<Window>> slots(examples.size());
  std::atomic<int> done = 0;
  base::parallelFor(config.panels, run.threads, [&](int i) {
    Example& example = examples[static_cast<std::size_t>(i)];
    example = drawExample(look, run.seed, i);
    Random random(run.seed, 1'000'000 + static_cast<std::uint64_t>(i));
    slots[static_cast<std::size_t>(i)] = firstWindows(example, config, describe, random);
    base::reportProgress(run.progress, {"rendering", ++done, config.panels});
  });
  const auto trained_on = static_cast<std::size_t>((1.0 - kHeldBack) * config.panels);
  std::vector<Window> windows;
  for (std::size_t i = 0; i < trained_on; ++i) {
    std::move(slots[i].begin(), slots[i].end(), std::back_inserter(windows));
  }
  TrainedDetector trained;
  trained.model = fitSvm(windows, config.cost, describe);
  for (int round = 0; round < config.rounds; ++round) {
    base::reportProgress(run.progress, {"training", round, config.rounds});
    std::vector<std::vector<Window>> hard(trained_on);
    base::parallelFor(static_cast<int>(trained_on), run.threads, [&](int i) {
      hard[static_cast<std::size_t>(i)] = hardWindows(examples[static_cast<std::size_t>(i)], trained.model, config);
    });
    for (std::vector<Window>& found : hard) {
      std::move(found.begin(), found.end(), std::back_inserter(windows));
    }
    trained.model = fitSvm(windows, config.cost, describe);
  }
  trained.positives = static_cast<int>(std::count_if(windows.begin(), windows.end(), [](const Window& w) { return w.is_knob; }));
  trained.negatives = static_cast<int>(windows.size()) - trained.positives;
  setThreshold(scoreHeldBack(examples, trained_on, trained.model, run.threads), config, trained);
  return trained;
}

}  // namespace oikos::recognition
