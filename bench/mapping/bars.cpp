// SPDX-License-Identifier: Apache-2.0
#include "bench/mapping/bars.h"

#include <cstdio>
#include <numbers>
#include <optional>
#include <string>

namespace oikos::bench {

namespace {

enum class Wish { kAtMost, kAtLeast };
using Measure = std::optional<double> (*)(const Scores&);

struct Bar {
  const char* what;
  const char* unit;
  int decimals;
  Wish wish;
  double must;
  double aim;
  const char* rtab_map;      ///< 0.23.8; default – SIFT where they differ
  const char* stella_vslam;  ///< ORB
  Measure measure;
};

double centimetres(double length_m) {
  return length_m * 100.0;
}

double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

template <class Function>
std::optional<double> of(const Scores& scores, const char* name, Function function) {
  const auto found = scores.find(name);
  return found == scores.end() ? std::nullopt : std::optional<double>(function(found->second));
}

double ateCm(const MappingScore& score) {
  return centimetres(score.error.absolute_m.rmse);
}

double rpeCm(const MappingScore& score) {
  return centimetres(score.error.per_interval.translation_m.rmse);
}

double rpeDeg(const MappingScore& score) {
  return degrees(score.error.per_interval.rotation_rad.rmse);
}

double lost(const MappingScore& score) {
  return score.lost;
}

double posesMissing(const MappingScore& score) {
  return score.frames - score.poses;
}

double peakMb(const MappingScore& score) {
  return score.peak_mb;
}

/// Of ten laps against one.
std::optional<double> lapRatio(const Scores& scores, double (*value)(const MappingScore&)) {
  const auto one = of(scores, "kitchen", value);
  const auto ten = of(scores, "kitchen-10-laps", value);
  return one && ten ? std::optional<double>(*ten / *one) : std::nullopt;
}

constexpr const char* kNone = "-";

// "at most 0" of poses missing: every frame has a pose.
const Bar kBars[] = {
    {"kitchen, ATE RMSE", "cm", 2, Wish::kAtMost, 1.3, 0.7, "1.84-1.97", "1.02", [](const Scores& s) { return of(s, "kitchen", ateCm); }},
    {"kitchen, RPE 1 s", "cm", 2, Wish::kAtMost, 1.0, 0.6, "1.45-1.17", "0.96", [](const Scores& s) { return of(s, "kitchen", rpeCm); }},
    {"kitchen, RPE 1 s", "deg", 2, Wish::kAtMost, 0.3, 0.2, "0.33-0.27", "0.30", [](const Scores& s) { return of(s, "kitchen", rpeDeg); }},
    {"kitchen, whole command", "frames/s", 1, Wish::kAtLeast, 20.0, 55.0, "18-9", "59 (no map)",
     [](const Scores& s) { return of(s, "kitchen", [](const MappingScore& score) { return score.bestFps(); }); }},
    {"kitchen, peak memory", "MB", 0, Wish::kAtMost, 350.0, 150.0, "200-270", "113",
     [](const Scores& s) { return of(s, "kitchen", peakMb); }},
    {"desk-rpy, ATE RMSE", "cm", 2, Wish::kAtMost, 3.0, 1.8, "10.7-10.5", "3.1-3.3 (334 frames)",
     [](const Scores& s) { return of(s, "desk-rpy", ateCm); }},
    {"desk-rpy, frames without a pose", "", 0, Wish::kAtMost, 0.0, 0.0, kNone, "16",
     [](const Scores& s) { return of(s, "desk-rpy", posesMissing); }},
    {"desk-rpy, RPE 1 s", "cm", 2, Wish::kAtMost, 4.5, 2.0, "8", "5.0", [](const Scores& s) { return of(s, "desk-rpy", rpeCm); }},
    {"desk-rpy, RPE 1 s", "deg", 2, Wish::kAtMost, 2.5, 1.2, "3.4", "2.9", [](const Scores& s) { return of(s, "desk-rpy", rpeDeg); }},
    {"household-box, largest error, aligned", "cm", 2, Wish::kAtMost, 2.0, 1.0, kNone, kNone,
     [](const Scores& s) {
       return of(s, "household-box", [](const MappingScore& score) { return centimetres(score.error.absolute_m.max); });
     }},
    {"household-box, largest error, first frame", "cm", 2, Wish::kAtMost, 2.0, 1.0, kNone, kNone,
     [](const Scores& s) {
       return of(s, "household-box", [](const MappingScore& score) { return centimetres(score.first_aligned_max_m); });
     }},
    {"kitchen-5hz, frames lost", "", 0, Wish::kAtMost, 0.0, 0.0, kNone, kNone, [](const Scores& s) { return of(s, "kitchen-5hz", lost); }},
    {"kitchen-5hz, ATE RMSE", "cm", 2, Wish::kAtMost, 4.0, 2.0, kNone, kNone, [](const Scores& s) { return of(s, "kitchen-5hz", ateCm); }},
    {"ten laps / one, peak memory", "x", 2, Wish::kAtMost, 1.5, 1.1, kNone, kNone, [](const Scores& s) { return lapRatio(s, peakMb); }},
};

/// Of the value as it is, not as it is rounded for the table.
const char* verdict(const Bar& bar, double limit, double value) {
  return (bar.wish == Wish::kAtMost ? value <= limit : value >= limit) ? "met" : "NOT MET";
}

std::string limitText(const Bar& bar, double limit, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%s %g %s", bar.wish == Wish::kAtMost ? "<=" : ">=", limit, verdict(bar, limit, value));
  return text;
}

}  // namespace

void printScores(const Scores& scores) {
  std::printf(
      "\n| recording | frames | lost | keyframes | loops | ATE RMSE cm | median | max | never moved | RPE 1 s cm | deg | frames/s | median "
      "| CPU s | peak MB |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [name, score] : scores) {
    const metrics::TrajectoryError& error = score.error;
    std::printf("| %s | %d | %d | %d | %d | %.2f | %.2f | %.2f | %.1f | %.2f | %.2f | %.1f | %.1f | %.1f | %.0f |\n", name.c_str(),
                score.frames, score.lost, score.keyframes, score.loops, ateCm(score), centimetres(error.absolute_m.median),
                centimetres(error.absolute_m.max), centimetres(error.motionless_absolute_m), rpeCm(score), rpeDeg(score), score.bestFps(),
                score.medianFps(), score.cpu_s, score.peak_mb);
  }
}

void printBars(const Scores& scores) {
  std::printf("\n| | unit | ours | must | aim | RTAB-Map | stella_vslam |\n|---|---|---|---|---|---|---|\n");
  for (const Bar& bar : kBars) {
    if (const auto value = bar.measure(scores)) {
      std::printf("| %s | %s | %.*f | %s | %s | %s | %s |\n", bar.what, bar.unit, bar.decimals, *value,
                  limitText(bar, bar.must, *value).c_str(), limitText(bar, bar.aim, *value).c_str(), bar.rtab_map, bar.stella_vslam);
    }
  }
}

}  // namespace oikos::bench
