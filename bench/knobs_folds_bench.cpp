// SPDX-License-Identifier: Apache-2.0
// Knobs by five-fold cross-validation, as the user's paper 003 has it (6.3.5): detection by histograms of gradients and a support vector
// machine, angles by a forest over 36 classes and by regression. Unlike there, the folds are of shapes: no knob that is tested has been
// trained on. Beside them, on the same pictures, the knob's own render.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <iterator>
#include <map>
#include <string>

#include "bench/knobs/rate.h"
#include "bench/knobs/trials.h"
#include "recognition/knobs/training/detector_training.h"

namespace {

using namespace oikos;
using namespace oikos::recognition;

constexpr std::size_t kFolds = 5;

struct Options {
  int images = 2000;
  int panels = 1000;
  int variants = 1;
  int threads = 2;
  std::uint64_t seed = 1;
};

/// All shapes there are, those of the training and those of the other benches.
std::vector<bench::NamedKnob> allKnobs() {
  std::vector<bench::NamedKnob> knobs = bench::testKnobs();
  for (const KnobMaker& maker : trainingKnobs()) {
    knobs.push_back({"training " + std::to_string(knobs.size() - bench::testKnobs().size()), maker});
  }
  return knobs;
}

struct Counts {
  long right = 0;
  long n = 0;
  void operator+=(const Counts& other) {
    right += other.right;
    n += other.n;
  }
};

struct Outcome {
  std::array<Counts, 2> detection;  ///< at 0 and at the fold's own threshold
  std::map<std::string, std::vector<double>> errors_deg;
  std::map<std::string, Counts> states;
};

/// A knob is right if it is found, a picture without any if nothing is.
Counts judgeDetection(const std::vector<bench::DetectionTrial>& trials, double threshold) {
  Counts counts;
  for (const bench::DetectionTrial& trial : trials) {
    long found = 0;
    long alarms = 0;
    for (const bench::Alarm& alarm : trial.alone) {
      found += alarm.score > threshold && alarm.is_knob ? 1 : 0;
      alarms += alarm.score > threshold && !alarm.is_knob ? 1 : 0;
    }
    counts += trial.knobs == 0 ? Counts{alarms == 0 ? 1 : 0, 1} : Counts{found, trial.knobs};
  }
  return counts;
}

Outcome runFold(std::size_t fold, const Options& options) {
  const std::vector<bench::NamedKnob> all = allKnobs();
  PanelLook training = trainingLook();
  training.knobs.clear();
  bench::TrialSetup setup;
  setup.look = bench::testLook();
  setup.look.knobs.clear();
  setup.knobs.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % kFolds == fold) {
      setup.knobs.push_back(all[i]);
      setup.look.knobs.push_back(all[i].maker);
    } else {
      training.knobs.push_back(all[i].maker);
    }
  }
  const std::uint64_t seed = options.seed * kFolds + fold;
  const TrainingRun run{seed, options.threads, {}};
  DetectorTrainingConfig detector;
  detector.panels = options.panels * static_cast<int>(kFolds - 1) / static_cast<int>(kFolds);
  AngleTrainingConfig angles;
  angles.renders = options.images * static_cast<int>(kFolds - 1) / static_cast<int>(kFolds);
  setup.detector = trainDetector(training, detector, run).model;
  const AngleModels models = trainAngles(training, angles, run);
  setup.angle_models = &models;
  setup.variants = options.variants;
  setup.has_confirmation = false;
  setup.seed = seed;
  setup.threads = options.threads;

  Outcome outcome;
  const std::vector<bench::DetectionTrial> detected = bench::runDetection(options.panels / static_cast<int>(kFolds), setup);
  outcome.detection = {judgeDetection(detected, 0.0), judgeDetection(detected, setup.detector.threshold)};
  for (const bench::ReadingTrial& trial : bench::runReading(options.images / static_cast<int>(kFolds), setup)) {
    outcome.states["own render"] += {trial.is_right ? 1 : 0, 1};
    if (trial.reading.state) {
      outcome.errors_deg["own render"].push_back(trial.error_deg);
    }
    for (const auto& [method, name] : enumTable(AngleMethod{})) {
      outcome.errors_deg[std::string(name)].push_back(trial.learnt_error_deg.at(method));
      outcome.states[std::string(name)] += {trial.learnt_is_right.at(method) ? 1 : 0, 1};
    }
  }
  return outcome;
}

void report(const std::string& name, const Outcome& outcome) {
  std::printf("%s\n  detection right: at 0 %s; at the threshold that training chose %s\n", name.c_str(),
              bench::rateText(outcome.detection[0].right, outcome.detection[0].n).c_str(),
              bench::rateText(outcome.detection[1].right, outcome.detection[1].n).c_str());
  for (const auto& [method, errors] : outcome.errors_deg) {
    const Counts& states = outcome.states.at(method);
    std::printf("  %-14s error %s deg (n %zu); right state of nine %s\n", method.c_str(), bench::meanText(errors).c_str(), errors.size(),
                bench::rateText(states.right, states.n).c_str());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Knobs by five-fold cross-validation over their shapes. The paper's size: --images 180000 --panels 1500.");
  app.add_option("--images", options.images, "pictures of one knob: of each fold four fifths to train angles on, a fifth to read")
      ->check(CLI::Range(100, 180000))
      ->capture_default_str();
  app.add_option("--panels", options.panels, "pictures with none, one or several knobs, likewise, for the detector")
      ->check(CLI::Range(100, 36000))
      ->capture_default_str();
  app.add_option("--variants", options.variants, "knobs of each shape that are read")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--threads", options.threads)->check(CLI::Range(1, 256))->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  Outcome all;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    Outcome outcome = runFold(fold, options);
    report("fold " + std::to_string(fold), outcome);
    for (std::size_t i = 0; i < all.detection.size(); ++i) {
      all.detection[i] += outcome.detection[i];
    }
    for (auto& [method, errors] : outcome.errors_deg) {
      std::move(errors.begin(), errors.end(), std::back_inserter(all.errors_deg[method]));
      all.states[method] += outcome.states[method];
    }
  }
  report("all folds", all);
  return 0;
}
