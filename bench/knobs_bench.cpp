// SPDX-License-Identifier: Apache-2.0
// Knobs found and read in simulated pictures. Their shapes, materials and lights are none that the detector was trained on; what is
// believed of them is off as a registration and a tape measure are.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "bench/knobs/fhog.h"
#include "bench/knobs/rate.h"
#include "bench/knobs/trials.h"
#include "core/base/degrees.h"
#include "core/base/read_file.h"
#include "recognition/knobs/training/detector_training.h"

namespace {

using namespace oikos;
using namespace oikos::recognition;

struct Options {
  int images = 600;
  int singles = 4000;
  int learnt = 0;
  int fhog = 0;
  int threads = 2;
  std::uint64_t seed = 1;
  std::string detector;
  bool has_training_look = false;
  bool has_photos = false;
};

// ---- Detection

using AlarmList = std::vector<bench::Alarm> bench::DetectionTrial::*;

/// An end of the interval of a Poisson count, by Byar's approximation.
double countEnd(long count, double deviations) {
  const auto c = static_cast<double>(count);
  return count == 0 ? 0.0 : c * std::pow(1.0 - 1.0 / (9.0 * c) + deviations / (3.0 * std::sqrt(c)), 3.0);
}

void reportAlarms(const char* name, const std::vector<bench::DetectionTrial>& trials, AlarmList list, double threshold) {
  long knobs = 0;
  long found = 0;
  long alarms = 0;
  for (const bench::DetectionTrial& trial : trials) {
    knobs += trial.knobs;
    for (const bench::Alarm& alarm : trial.*list) {
      found += alarm.score > threshold && alarm.is_knob ? 1 : 0;
      alarms += alarm.score > threshold && !alarm.is_knob ? 1 : 0;
    }
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, trials.size()));
  std::printf("%-22s at %5.2f: found %s; %ld false alarms, %.3f an image (%.3f to %.3f)\n", name, threshold,
              bench::rateText(found, knobs).c_str(), alarms, static_cast<double>(alarms) / n, countEnd(alarms, -1.96) / n,
              countEnd(alarms + 1, 1.96) / n);
}

/// The least threshold that leaves no more than 0.05 false alarms an image.
double thresholdFor(const std::vector<bench::DetectionTrial>& trials, AlarmList list) {
  constexpr double kAlarmsPerImage = 0.05;
  std::vector<double> alarms;
  for (const bench::DetectionTrial& trial : trials) {
    for (const bench::Alarm& alarm : trial.*list) {
      if (!alarm.is_knob) {
        alarms.push_back(alarm.score);
      }
    }
  }
  std::sort(alarms.begin(), alarms.end(), std::greater<>());
  const auto allowed = static_cast<std::size_t>(kAlarmsPerImage * static_cast<double>(trials.size()));
  return allowed < alarms.size() ? alarms[allowed] : -std::numeric_limits<double>::infinity();
}

void reportDetection(const std::vector<bench::DetectionTrial>& trials, const DetectorModel& detector) {
  for (const double threshold : {-0.5, 0.0, 0.5, static_cast<double>(detector.threshold)}) {
    reportAlarms("detector alone", trials, &bench::DetectionTrial::alone, threshold);
  }
  const double own = KnobReaderConfig().min_score;
  for (const double threshold : {own, own + 0.5, own + 1.0, own + 2.0}) {
    reportAlarms("with the knob's render", trials, &bench::DetectionTrial::confirmed, threshold);
  }
  std::printf("At most 0.05 false alarms an image:\n");
  reportAlarms("detector alone", trials, &bench::DetectionTrial::alone, thresholdFor(trials, &bench::DetectionTrial::alone));
  reportAlarms("with the knob's render", trials, &bench::DetectionTrial::confirmed,
               thresholdFor(trials, &bench::DetectionTrial::confirmed));
  double ms = 0.0;
  double alone_ms = 0.0;
  int regions = 0;
  for (const bench::DetectionTrial& trial : trials) {
    ms += trial.ms;
    alone_ms += trial.alone_ms;
    regions += trial.regions;
  }
  const double images = static_cast<double>(std::max<std::size_t>(1, trials.size()));
  std::printf("%.2f ms a region, %.2f an image; detector alone %.2f and %.2f\n\n", ms / std::max(1, regions), ms / images,
              alone_ms / std::max(1, regions), alone_ms / images);
}

/// Trained as the shipped detector is, with dlib's numbers in place of ours.
void reportFhog(const CellDescriber& fhog, const Options& options, bench::TrialSetup setup) {
  DetectorTrainingConfig config;
  config.panels = options.fhog;
  const TrainedDetector trained = trainDetector(trainingLook(), config, {0, options.threads, {}}, fhog);
  std::printf("dlib's FHOG: %zu numbers a window; %d knobs and %d other windows of %d renders\n", trained.model.weights.size(),
              trained.positives, trained.negatives, config.panels);
  setup.detector = trained.model;
  reportDetection(bench::runDetection(options.images, setup), setup.detector);
}

// ---- Reading

void reportReadings(const std::string& name, const std::vector<const bench::ReadingTrial*>& trials) {
  long right = 0;
  long told = 0;
  long told_right = 0;
  std::vector<double> errors;
  double sum = 0.0;
  std::vector<double> normalised;
  for (const bench::ReadingTrial* trial : trials) {
    right += trial->is_right ? 1 : 0;
    told += trial->reading.status == KnobStatus::kRead ? 1 : 0;
    told_right += trial->reading.status == KnobStatus::kRead && trial->is_right ? 1 : 0;
    if (trial->reading.state) {
      sum += trial->error_deg;
      errors.push_back(trial->error_deg);
      normalised.push_back(std::pow(trial->error_deg * base::kRadPerDeg / trial->reading.sigma_rad, 2));
    }
  }
  std::sort(errors.begin(), errors.end());
  std::sort(normalised.begin(), normalised.end());
  const auto quantile = [](const std::vector<double>& values, double share) {
    return values.empty() ? 0.0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const auto n = static_cast<long>(trials.size());
  std::printf("%-14s error mean %.2f median %.2f p95 %.2f deg; right %s; told %.1f %%, of them right %s; nees median %.2f\n", name.c_str(),
              sum / static_cast<double>(std::max<std::size_t>(1, errors.size())), quantile(errors, 0.5), quantile(errors, 0.95),
              bench::rateText(right, n).c_str(), 100.0 * static_cast<double>(told) / static_cast<double>(std::max(1L, n)),
              bench::rateText(told_right, told).c_str(), quantile(normalised, 0.5));
}

/// How often a state is right that has such a probability, and how far angles are off in units of their deviations.
void reportHonesty(const std::vector<bench::ReadingTrial>& trials) {
  constexpr std::array<double, 8> kFrom = {0.0, 0.3, 0.5, 0.7, 0.9, 0.97, 0.99, 0.999};
  for (std::size_t i = 0; i < kFrom.size(); ++i) {
    const double to = i + 1 < kFrom.size() ? kFrom[i + 1] : 1.1;
    long right = 0;
    std::vector<double> stated;
    for (const bench::ReadingTrial& trial : trials) {
      if (trial.reading.state && trial.reading.probability >= kFrom[i] && trial.reading.probability < to) {
        stated.push_back(trial.reading.probability);
        right += trial.is_right ? 1 : 0;
      }
    }
    std::printf("probability from %.3f, mean %s: right %s\n", kFrom[i], bench::meanText(stated).c_str(),
                bench::rateText(right, static_cast<long>(stated.size())).c_str());
  }
  std::array<long, 3> within{};
  std::vector<double> squares;
  for (const bench::ReadingTrial& trial : trials) {
    if (trial.reading.state) {
      const double off = trial.error_deg * base::kRadPerDeg / trial.reading.sigma_rad;
      squares.push_back(off * off);
      for (std::size_t i = 0; i < within.size(); ++i) {
        within[i] += off < static_cast<double>(i + 1) ? 1 : 0;
      }
    }
  }
  std::printf("squared error in deviations: mean %s", bench::meanText(squares).c_str());
  for (std::size_t i = 0; i < within.size(); ++i) {
    std::printf("; within %zu: %s", i + 1, bench::rateText(within[i], static_cast<long>(squares.size())).c_str());
  }
  std::printf("\n");
}

void reportLearnt(const std::vector<bench::ReadingTrial>& trials) {
  for (const auto& [method, name] : enumTable(AngleMethod{})) {
    double sum = 0.0;
    long right = 0;
    for (const bench::ReadingTrial& trial : trials) {
      sum += trial.learnt_error_deg.at(method);
      right += trial.learnt_is_right.at(method) ? 1 : 0;
    }
    std::printf("%-14s error mean %.2f deg; right %s\n", std::string(name).c_str(), sum / static_cast<double>(trials.size()),
                bench::rateText(right, static_cast<long>(trials.size())).c_str());
  }
}

void reportReading(const std::vector<bench::ReadingTrial>& trials) {
  std::map<std::string, std::vector<const bench::ReadingTrial*>> groups;
  double ms = 0.0;
  for (const bench::ReadingTrial& trial : trials) {
    ms += trial.ms;
    groups["all"].push_back(&trial);
    groups[bench::testKnobs()[trial.family].name].push_back(&trial);
    groups["tilt " + std::to_string(static_cast<int>(trial.tilt_deg / 10.0) * 10)].push_back(&trial);
    groups[trial.diameter_px < 36.0 ? "24 to 36 px" : trial.diameter_px < 60.0 ? "36 to 60 px" : "60 to 120 px"].push_back(&trial);
    groups["= " + std::string(base::toString(trial.reading.status))].push_back(&trial);
  }
  for (const auto& [name, of] : groups) {
    reportReadings(name, of);
  }
  reportHonesty(trials);
  if (!trials.empty() && !trials.front().learnt_error_deg.empty()) {
    reportLearnt(trials);
  }
  std::printf("%.2f ms a knob\n", ms / static_cast<double>(std::max<std::size_t>(1, trials.size())));
}

void reportPhotos(int count, bench::TrialSetup setup) {
  std::printf("\nTemplates made of one photograph of each knob, its middle marked\n");
  setup.templates = bench::TemplateSource::kPhoto;
  reportReading(bench::runReading(count, setup));
  std::printf("\nTemplates made of one photograph of each knob, its middle where the registration says\n");
  setup.templates = bench::TemplateSource::kRegistered;
  reportReading(bench::runReading(count, setup));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Knobs found and read in simulated pictures.");
  app.add_option("--images", options.images, "pictures for detection, with none, one or several knobs");
  app.add_option("--singles", options.singles, "pictures of one knob");
  app.add_option("--learnt", options.learnt, "renders to train the forest and the regressions on, which are then measured, too");
  app.add_option("--fhog", options.fhog, "renders to train the detector on with dlib's FHOG in place of ours, which is then measured, too")
      ->check(CLI::Range(10, 36000));
  app.add_option("--threads", options.threads);
  app.add_option("--seed", options.seed);
  app.add_option("--detector", options.detector, "a file that `oikos model train knobs` has written, instead of the shipped one");
  app.add_flag("--photos", options.has_photos, "also read with templates made of one photograph of each knob in place of its render");
  app.add_flag("--training-look", options.has_training_look, "detection in pictures like those of the training, to choose thresholds on");
  CLI11_PARSE(app, argc, argv);
  const std::optional<CellDescriber> fhog = bench::findFhog();
  if (options.fhog > 0 && !fhog) {
    std::fprintf(stderr, "--fhog: this build has found no dlib: install libdlib-dev and configure anew\n");
    return 1;
  }
  bench::TrialSetup setup;
  setup.look = options.has_training_look ? trainingLook() : bench::testLook();
  setup.detector = options.detector.empty() ? shippedDetector() : parseDetector(base::readFile(options.detector), options.detector);
  setup.seed = options.seed;
  setup.threads = options.threads;
  if (options.images > 0) {
    reportDetection(bench::runDetection(options.images, setup), setup.detector);
    if (options.fhog > 0) {
      reportFhog(*fhog, options, setup);
    }
  }
  if (options.singles > 0) {
    std::optional<AngleModels> models;
    if (options.learnt > 0) {
      AngleTrainingConfig config;
      config.renders = options.learnt;
      models.emplace(trainAngles(trainingLook(), config, {0, options.threads, {}}));
      setup.angle_models = &*models;
    }
    reportReading(bench::runReading(options.singles, setup));
    if (options.has_photos) {
      setup.angle_models = nullptr;
      reportPhotos(options.singles, setup);
    }
  }
  return 0;
}
