// SPDX-License-Identifier: Apache-2.0
// How well doors and drawers of ten kinds of furniture are read from one depth image of a simulated sensor, their home being believed to a
// few millimetres and their joints anywhere.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "bench/articulated/sequence.h"
#include "bench/articulated/trial.h"

namespace {

using namespace oikos;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kVisible = 0.15;

/// Wilson's interval at 95 %, as text: "12 of 300, 4.0 % (2.3-6.9)".
std::string rate(int hits, int n) {
  constexpr double kZ = 1.96;
  const double count = std::max(1, n);
  const double p = hits / count;
  const double middle = (p + kZ * kZ / (2.0 * count)) / (1.0 + kZ * kZ / count);
  const double half = kZ / (1.0 + kZ * kZ / count) * std::sqrt(p * (1.0 - p) / count + kZ * kZ / (4.0 * count * count));
  char text[80];
  std::snprintf(text, sizeof text, "%.2f (%.2f-%.2f)", 100.0 * p, 100.0 * std::max(0.0, middle - half), 100.0 * (middle + half));
  return text;
}

struct Tally {
  int all = 0;
  int visible = 0;
  int right = 0;        ///< of the visible ones
  int abstained = 0;    ///< of the visible ones
  int found = 0;        ///< of all
  int found_wrong = 0;  ///< of all
  int turns = 0;
  int slides = 0;
  double error_deg = 0.0;   ///< of those found that turn
  double error_m = 0.0;     ///< of those found that slide
  double normalised = 0.0;  ///< squared error over variance, of those found and right

  void add(const bench::JointTrial& joint) {
    ++all;
    if (joint.visible >= kVisible) {
      ++visible;
      right += joint.isRight() && joint.isFound() ? 1 : 0;
      abstained += joint.isFound() ? 0 : 1;
    }
    if (!joint.isFound()) {
      return;
    }
    ++found;
    found_wrong += joint.isRight() ? 0 : 1;
    (joint.is_turn ? turns : slides) += 1;
    (joint.is_turn ? error_deg : error_m) += joint.is_turn ? joint.error() / kDegree : joint.error();
    normalised += joint.isRight() ? joint.error() * joint.error() / joint.variance : 0.0;
  }
};

double median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void report(const std::string& name, const Tally& tally, const std::vector<double>& ms) {
  std::printf("| %-13s | %5d | %5d | %-22s | %-20s | %5d | %-18s | %.2f | %.1f | %.2f | %.1f |\n", name.c_str(), tally.all, tally.visible,
              rate(tally.right, tally.visible).c_str(), rate(tally.abstained, tally.visible).c_str(), tally.found,
              rate(tally.found_wrong, tally.found).c_str(), tally.error_deg / std::max(1, tally.turns),
              1000.0 * tally.error_m / std::max(1, tally.slides), tally.normalised / std::max(1, tally.found - tally.found_wrong),
              median(ms));
}

void print(const bench::PieceTrial& trial) {
  for (const bench::JointTrial& joint : trial.joints) {
    const double unit = joint.is_turn ? kDegree : 0.01;
    std::printf(
        "%5d %-13s %-22s %-15s true %6.2f found %6.2f sigma %5.2f prior %6.2f conf %.3f visible %.2f agree %d near %d behind %d %s%s\n",
        trial.number, trial.kind.c_str(), joint.joint.c_str(), std::string(base::toString(joint.status)).c_str(), joint.true_value / unit,
        joint.value / unit, std::sqrt(joint.variance) / unit, joint.prior / unit, joint.confidence, joint.visible, joint.sight.agreeing,
        joint.sight.nearer, joint.sight.behind, joint.isFound() && !joint.isRight() ? "WRONG" : "",
        !joint.isFound() && joint.visible >= kVisible ? "ABSTAINED" : "");
  }
}

/// Fused over the images of a drive.
struct SequenceTally {
  int moved = 0;
  int moved_right = 0;  ///< split at the right image
  int still = 0;
  int still_right = 0;  ///< not split
  int found = 0;        ///< last spans
  int wrong = 0;
  int turns = 0;
  int slides = 0;
  double error_deg = 0.0;
  double error_m = 0.0;
  double single_deg = 0.0;  ///< mean error of the same span's images, each by itself
  double single_m = 0.0;
  double normalised = 0.0;

  void add(const bench::JointSequence& sequence) {
    if (sequence.found == 0) {
      return;  // not seen by any image by itself
    }
    (sequence.has_moved ? moved : still) += 1;
    (sequence.has_moved ? moved_right : still_right) += sequence.is_split_right ? 1 : 0;
    if (sequence.status != registration::JointStatus::kFound) {
      return;
    }
    ++found;
    const bool is_right = sequence.error <= (sequence.is_turn ? 5.0 * kDegree : 0.02);
    wrong += is_right ? 0 : 1;
    (sequence.is_turn ? turns : slides) += 1;
    (sequence.is_turn ? error_deg : error_m) += sequence.is_turn ? sequence.error / kDegree : sequence.error;
    (sequence.is_turn ? single_deg : single_m) += sequence.is_turn ? sequence.mean_error / kDegree : sequence.mean_error;
    normalised += is_right ? sequence.error * sequence.error / sequence.variance : 0.0;
  }
};

void runSequences(int first, int count, const bench::SequenceSettings& settings, bool verbose) {
  SequenceTally tally;
  for (int i = first; i < first + count; ++i) {
    for (const bench::JointSequence& sequence : bench::runSequence(i, settings)) {
      tally.add(sequence);
      if (verbose) {
        const double unit = sequence.is_turn ? kDegree : 0.01;
        std::printf("%5d %-13s %-22s %s spans %zu %s error %.2f sigma %.2f single %.2f of %d%s\n", i, sequence.kind.c_str(),
                    sequence.joint.c_str(), sequence.has_moved ? "moved" : "still", sequence.spans,
                    std::string(base::toString(sequence.status)).c_str(), sequence.error / unit, std::sqrt(sequence.variance) / unit,
                    sequence.mean_error / unit, sequence.found, sequence.is_split_right ? "" : " SPLIT WRONG");
      }
    }
  }
  std::printf("%d images each. Moved joints, split at the right image %%: %s of %d; still ones, not split %%: %s of %d\n", settings.frames,
              rate(tally.moved_right, tally.moved).c_str(), tally.moved, rate(tally.still_right, tally.still).c_str(), tally.still);
  std::printf("last span: found %d, wrong %% %s; %.2f deg (single images %.2f), %.1f mm (%.1f), error^2/variance %.2f\n", tally.found,
              rate(tally.wrong, tally.found).c_str(), tally.error_deg / std::max(1, tally.turns),
              tally.single_deg / std::max(1, tally.turns), 1000.0 * tally.error_m / std::max(1, tally.slides),
              1000.0 * tally.single_m / std::max(1, tally.slides), tally.normalised / std::max(1, tally.found - tally.wrong));
}

/// Each image by itself.
void runTrials(int first, int count, const bench::TrialSettings& settings, bool verbose) {
  std::map<std::string, Tally> tallies;
  std::map<std::string, std::vector<double>> ms;
  double base_m = 0.0;
  double base_deg = 0.0;
  for (int i = first; i < first + count; ++i) {
    const bench::PieceTrial trial = bench::runTrial(i, settings);
    for (const bench::JointTrial& joint : trial.joints) {
      tallies[trial.kind].add(joint);
      tallies["all"].add(joint);
    }
    ms[trial.kind].push_back(trial.ms);
    ms["all"].push_back(trial.ms);
    base_m += trial.base_error_m;
    base_deg += trial.base_error_deg;
    if (verbose) {
      print(trial);
    }
  }
  std::printf(
      "| kind | joints | visible | of these right %% (95 %%) | abstained %% | found | of these wrong %% | deg | mm | error^2/variance | "
      "CPU ms "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& kind : bench::worldKinds()) {
    report(kind, tallies[kind], ms[kind]);
  }
  report("all", tallies["all"], ms["all"]);
  std::printf("base: %.1f mm, %.2f deg\n", 1000.0 * base_m / count, base_deg / count);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Doors and drawers from one depth image: accuracy, wrong answers, abstentions, time"};
  bench::SequenceSettings sequence;
  bench::TrialSettings& settings = sequence.trial;
  int trials = 1500;
  int first = 0;
  int frames = 0;
  bool verbose = false;
  std::string sensor = "kinect1";
  std::string order = "together";
  app.add_option("--trials", trials, "images; ten kinds of furniture take turns")->check(CLI::PositiveNumber);
  app.add_option("--first", first, "number of the first");
  app.add_option("--sensor", sensor, "ideal, kinect1, kinect2")->check(CLI::IsMember({"ideal", "kinect1", "kinect2"}));
  app.add_option("--dimension-m", settings.world.dimension_m, "deviation of each length from the model's");
  app.add_option("--axis-m", settings.world.axis_m, "of each coordinate of a joint's origin");
  app.add_option("--axis-deg", settings.world.axis_deg, "of its direction");
  app.add_option("--shift-m", settings.world.shift_m, "the piece stands so far from where it is believed");
  app.add_option("--shift-deg", settings.world.shift_deg, "and is turned so far");
  app.add_option("--occluded", settings.world.occluded, "share of the piece's width that a person hides");
  app.add_option("--order", order, "'part after part' or 'together'")->check(CLI::IsMember({"part after part", "together"}));
  app.add_option("--seed", settings.seed, "of the trials");
  app.add_option("--tempering", settings.config.solver.tempering, "of a reading's information");
  app.add_option("--most-readings", settings.config.solver.most_readings, "that a link counts for");
  app.add_option("--base-sigma-m", settings.config.solver.base_sigma_m, "how well the piece's place is believed to be known");
  app.add_option("--base-sigma-deg", settings.config.solver.base_sigma_deg, "and its yaw");
  app.add_option("--rounds", settings.config.solver.rounds, "of solving");
  app.add_option("--frames", frames, "of a drive past each piece, one of whose joints is moved meanwhile; 0: single images");
  app.add_flag("--verbose", verbose, "a line for each joint");
  CLI11_PARSE(app, argc, argv);
  settings.world.sensor = base::findEnum<camera::DepthSensorKind>(sensor).value_or(settings.world.sensor);
  settings.config.order = base::findEnum<registration::SolveOrder>(order).value_or(settings.config.order);
  if (frames > 0) {
    sequence.frames = frames;
    runSequences(first, trials, sequence, verbose);
  } else {
    runTrials(first, trials, settings, verbose);
  }
  return 0;
}
