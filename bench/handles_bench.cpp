// SPDX-License-Identifier: Apache-2.0
// How exactly handles are found in one depth image of a simulated sensor, on doors and drawers that stand anywhere and were registered in
// the same image; their home is believed to a few millimetres, the handles to 3 to 20 mm.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "bench/handles/handle_trial.h"

namespace {

using namespace oikos;

/// Wilson's interval at 95 %, as text.
std::string rate(int hits, int n) {
  constexpr double kZ = 1.96;
  const double count = std::max(1, n);
  const double p = hits / count;
  const double middle = (p + kZ * kZ / (2.0 * count)) / (1.0 + kZ * kZ / count);
  const double half = kZ / (1.0 + kZ * kZ / count) * std::sqrt(p * (1.0 - p) / count + kZ * kZ / (4.0 * count * count));
  char text[80];
  std::snprintf(text, sizeof text, "%.1f (%.1f-%.1f)", 100.0 * p, 100.0 * std::max(0.0, middle - half), 100.0 * (middle + half));
  return text;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Tally {
  int all = 0;
  int found = 0;
  int far = 0;  ///< of those found: 2 cm off and more
  std::vector<double> error_mm, normal_deg, rotation_deg, prior_mm, prior_deg, length_mm, ms, off_mm[3], normalised[3];

  void add(const bench::HandleTrial& trial) {
    const bool is_found = trial.status == registration::HandleStatus::kFound || trial.status == registration::HandleStatus::kPartly;
    ms.push_back(trial.ms);
    ++all;
    if (!is_found) {
      return;
    }
    ++found;
    far += trial.error_m > 0.02 ? 1 : 0;
    error_mm.push_back(1000.0 * trial.error_m);
    normal_deg.push_back(trial.normal_error_deg);
    rotation_deg.push_back(trial.rotation_error_deg);
    prior_mm.push_back(1000.0 * trial.prior_error_m);
    prior_deg.push_back(trial.prior_normal_error_deg);
    length_mm.push_back(1000.0 * std::abs(trial.length_error_m));
    for (int i = 0; i < 3; ++i) {
      off_mm[i].push_back(1000.0 * std::abs(trial.off_m[i]));
      normalised[i].push_back(trial.off_m[i] * trial.off_m[i] / (trial.sigma_m[i] * trial.sigma_m[i]));
    }
  }
};

void report(const std::string& name, const Tally& t) {
  std::printf(
      "| %-18s | %4d | %-18s | %4.1f, %4.1f | %.1f, %.1f, %.1f | %.2f, %.2f | %.2f | %4.1f, %.2f | %d | %.1f, %.1f, %.1f | %.1f | %.1f, "
      "%.1f |\n",
      name.c_str(), t.all, rate(t.found, t.all).c_str(), mean(t.error_mm), quantile(t.error_mm, 0.95), mean(t.off_mm[0]), mean(t.off_mm[1]),
      mean(t.off_mm[2]), mean(t.normal_deg), quantile(t.normal_deg, 0.95), mean(t.rotation_deg), mean(t.prior_mm), mean(t.prior_deg), t.far,
      mean(t.normalised[0]), mean(t.normalised[1]), mean(t.normalised[2]), mean(t.length_mm), quantile(t.ms, 0.5), quantile(t.ms, 0.99));
}

void print(const bench::HandleTrial& t) {
  std::printf(
      "%4d %-18s %-20s %-14s visible %.2f slant %2.0f at %.2f m, off %5.1f mm (%5.1f %5.1f %5.1f, sigma %.1f %.1f %.1f) normal %.2f deg "
      "all %.2f, "
      "prior %.1f mm %.2f deg, length %.1f mm, gain %.0f, points %d, %.1f ms\n",
      t.number, t.kind.c_str(), t.name.c_str(), std::string(base::toString(t.status)).c_str(), t.visible, t.slant_deg, t.distance_m,
      1000.0 * t.error_m, 1000.0 * t.off_m.x(), 1000.0 * t.off_m.y(), 1000.0 * t.off_m.z(), 1000.0 * t.sigma_m.x(), 1000.0 * t.sigma_m.y(),
      1000.0 * t.sigma_m.z(), t.normal_error_deg, t.rotation_error_deg, 1000.0 * t.prior_error_m, t.prior_normal_error_deg,
      1000.0 * t.length_error_m, t.gain, t.points, t.ms);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Handles of registered doors and drawers from one depth image: accuracy, share found, time"};
  bench::HandleTrialSettings settings;
  int trials = 400;
  int first = 0;
  bool is_verbose = false;
  std::string sensor = "kinect1";
  app.add_option("--trials", trials, "images; ten kinds of furniture take turns")->check(CLI::PositiveNumber);
  app.add_option("--first", first, "number of the first");
  app.add_option("--sensor", sensor, "ideal, kinect1, kinect2")->check(CLI::IsMember({"ideal", "kinect1", "kinect2"}));
  app.add_option("--least-m", settings.least_m, "camera before the piece's front, at least");
  app.add_option("--most-m", settings.most_m, "and at most");
  app.add_option("--most-off-axis-deg", settings.most_off_axis_deg, "to either side of what the piece faces");
  app.add_option("--dimension-m", settings.world.dimension_m, "deviation of each length from the model's");
  app.add_option("--most-displaced-m", settings.most_displaced_m, "of each handle on its front");
  app.add_option("--seed", settings.seed, "of the trials");
  app.add_flag("--verbose", is_verbose, "a line for each handle");
  CLI11_PARSE(app, argc, argv);
  settings.world.sensor = base::findEnum<camera::DepthSensorKind>(sensor).value_or(settings.world.sensor);
  std::map<std::string, Tally> tallies;
  for (int i = first; i < first + trials; ++i) {
    for (const bench::HandleTrial& trial : bench::runHandleTrial(i, settings)) {
      if (!trial.is_visible) {
        tallies["not visible"].add(trial);
      } else {
        tallies[trial.kind].add(trial);
        tallies[trial.is_knob ? "all knobs" : "all bars"].add(trial);
        tallies[trial.distance_m < 1.4 ? "nearer than 1.4 m" : "farther"].add(trial);
        tallies[trial.slant_deg < 45.0 ? "below 45 deg" : "45 to 60 deg"].add(trial);
        tallies["all"].add(trial);
      }
      if (is_verbose) {
        print(trial);
      }
    }
  }
  std::printf(
      "| kind | visible | of these found %% (95 %%) | mm, 95 %% | out, across, along | normal deg, 95 %% | all of it deg | prior mm, deg | "
      "2 cm off | error^2/variance | length mm | CPU ms, 99 %% |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const bench::WorldKind& kind : bench::handleKinds()) {
    report(kind.name, tallies[kind.name]);
  }
  for (const std::string name :
       {"all bars", "all knobs", "nearer than 1.4 m", "farther", "below 45 deg", "45 to 60 deg", "all", "not visible"}) {
    report(name, tallies[name]);
  }
  return 0;
}
