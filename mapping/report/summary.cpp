// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/summary.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "mapping/report/text.h"

namespace oikos::mapping {

namespace {

constexpr double kManyLost = 0.20;        ///< share of frames; beyond it the map has holes that nobody knows
constexpr double kSomeLost = 0.02;        ///< below it, tracking bridges the gaps
constexpr double kSomeCarried = 0.02;     ///< share of frames; beyond it the wheels' drift is in the map
constexpr double kManySkipped = 0.05;     ///< share of listed frames
constexpr double kHighResidual_px = 2.0;  ///< well-calibrated cameras stay below one pixel
constexpr double kLongPath_m = 5.0;       ///< without a loop, drift over more than this goes unnoticed
constexpr int kFewestFrames = 2;
constexpr std::size_t kStretchesNamed = 3;

double share(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : 0.0;
}

using Findings = std::vector<Finding>;

struct Stretch {
  std::size_t begin = 0;  ///< first frame
  std::size_t end = 0;    ///< one past the last
};

/// The longest first; of equally long ones the earlier.
std::vector<Stretch> stretchesOf(FrameStatus status, const std::vector<FrameFacts>& frames) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].status != status) {
      continue;
    }
    if (stretches.empty() || stretches.back().end != i) {
      stretches.push_back({i, i});
    }
    stretches.back().end = i + 1;
  }
  std::stable_sort(stretches.begin(), stretches.end(),
                   [](const Stretch& a, const Stretch& b) { return a.end - a.begin > b.end - b.begin; });
  return stretches;
}

/// "at 8.1–10.0 ss, 12.4–12.5 s and elsewhere": the longest few.
std::string whereIn(const MapReport& report, FrameStatus status) {
  const auto since_start = [&report](std::size_t frame) {
    const std::int64_t passed_ns = report.trajectory[frame].stamp_ns - report.trajectory.front().stamp_ns;
    return numberText(static_cast<double>(passed_ns) * 1e-9, 1);
  };
  const std::vector<Stretch> stretches = stretchesOf(status, report.frames);
  std::string text;
  for (std::size_t i = 0; i < std::min(kStretchesNamed, stretches.size()); ++i) {
    text += (i == 0 ? "at " : ", ") + since_start(stretches[i].begin) + "–" + since_start(stretches[i].end - 1) + " s";
  }
  return text + (stretches.size() > kStretchesNamed ? " and elsewhere" : "");
}

void judgeTracking(const MapReport& report, const ReportFigures& figures, Findings& findings) {
  if (figures.frames - figures.lost < kFewestFrames) {
    findings.push_back({MapVerdict::kNotUsable, "The camera's motion could not be followed.",
                        "Check that the lens is clean, the room is lit and depth is recorded, then drive again."});
    return;
  }
  if (figures.lost > 0) {
    const double lost = share(figures.lost, figures.frames);
    const MapVerdict weight = lost > kManyLost   ? MapVerdict::kNotUsable
                              : lost > kSomeLost ? MapVerdict::kUsableWithCare
                                                 : MapVerdict::kUsable;
    findings.push_back(
        {weight,
         "The camera was lost in " + countedText(figures.lost, "frame", "frames") + " (" + shareText(figures.lost, figures.frames) + "), " +
             whereIn(report, FrameStatus::kLost) + " of the drive; each has a pose between those about it.",
         weight == MapVerdict::kUsable ? "" : "Drive these stretches again, slower, and turn where there is something to see."});
  }
  if (const int apart = report.submaps - report.submaps_joined; apart > 0) {
    findings.push_back({MapVerdict::kUsableWithCare,
                        countedText(apart, "piece", "pieces") + " of the drive could not be joined to the map and " +
                            (apart == 1 ? "is" : "are") + " missing from it.",
                        "Drive once more through the place where tracking was lost, so that both sides are seen in one go."});
  }
}

void judgeOdometry(const MapReport& report, const ReportFigures& figures, Findings& findings) {
  if (figures.carried == 0) {
    return;
  }
  const MapVerdict weight = share(figures.carried, figures.frames) > kSomeCarried ? MapVerdict::kUsableWithCare : MapVerdict::kUsable;
  findings.push_back({weight,
                      "The camera could not be followed in " + countedText(figures.carried, "frame", "frames") + " (" +
                          shareText(figures.carried, figures.frames) + "), " + whereIn(report, FrameStatus::kCarried) +
                          " of the drive; the wheels' odometry carried them, with its drift.",
                      weight == MapVerdict::kUsable ? "" : "Drive where there is something to see, or hold the map against a floor plan."});
}

void judgeLoops(const MapReport& report, const ReportFigures& figures, Findings& findings) {
  if (figures.loops_accepted == 0 && figures.path_m > kLongPath_m) {
    findings.push_back({MapVerdict::kUsable, "No loop was closed, so drift could not be taken out or measured.",
                        "End the drive where it began, looking the same way."});
  }
  if (figures.loops_down_weighted > 0) {
    findings.push_back({MapVerdict::kUsable,
                        countedText(figures.loops_down_weighted, "loop was", "loops were") + " found wrong and given no say in the map.",
                        ""});
  }
  if (!report.optimisation.converged && report.optimisation.iterations > 0) {
    findings.push_back({MapVerdict::kUsableWithCare, "The optimisation stopped at its limit of iterations before it had settled.", ""});
  }
}

void judgeInput(const MapReport& report, const ReportFigures& figures, Findings& findings) {
  const RecordingFacts& recording = report.recording;
  const int unused = recording.skipped + recording.unmatched;
  if (share(unused, recording.frames_listed) > kManySkipped) {
    findings.push_back({MapVerdict::kUsableWithCare,
                        countedText(unused, "frame", "frames") + " of " + countText(recording.frames_listed) + " could not be used.",
                        "Check the recorder: a slow disk or a loose USB cable loses frames."});
  }
  if (figures.median_residual_px > kHighResidual_px) {
    findings.push_back({MapVerdict::kUsableWithCare,
                        "Matches miss by " + numberText(figures.median_residual_px, 1) + " px in the middle frame.",
                        "Check the camera's calibration: under one pixel is normal."});
  }
  if (report.floor.status == FloorSighting::kNotInSight) {
    findings.push_back({MapVerdict::kUsableWithCare,
                        "The floor was never in sight: heights count from the first camera, and the 2D grid is unknown.",
                        "Tilt the camera so that some floor shows in the picture."});
  }
}

std::string storyOf(const MapReport& report, const ReportFigures& figures) {
  std::string story = countText(figures.frames - figures.lost) + " of " + countedText(figures.frames, "frame has", "frames have") +
                      " a place along a path of " + lengthText(figures.path_m) + ".";
  if (figures.loops_accepted > 0) {
    story += " " + countedText(figures.loops_accepted, "loop was", "loops were") + " closed";
    story +=
        report.trajectory_before_loops.empty() ? "." : ", which moved the path by up to " + lengthText(figures.largest_correction_m) + ".";
  }
  if (report.floor.status == FloorSighting::kFound) {
    story += " The floor was found " + lengthText(report.floor.camera_height_m) + " below the camera; " +
             numberText(figures.free_area_m2, 1) + " m² of it are known to be free.";
  }
  return story;
}

std::string headlineOf(MapVerdict verdict) {
  switch (verdict) {
    case MapVerdict::kUsable:
      return "The map is usable.";
    case MapVerdict::kUsableWithCare:
      return "The map is usable, with care.";
    case MapVerdict::kNotUsable:
      break;
  }
  return "The map is not usable.";
}

}  // namespace

MapSummary summarise(const MapReport& report, const ReportFigures& figures) {
  MapSummary summary;
  judgeTracking(report, figures, summary.findings);
  judgeOdometry(report, figures, summary.findings);
  judgeLoops(report, figures, summary.findings);
  judgeInput(report, figures, summary.findings);
  std::stable_sort(summary.findings.begin(), summary.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.weight > b.weight; });
  summary.verdict = summary.findings.empty() ? MapVerdict::kUsable : summary.findings.front().weight;
  summary.headline = headlineOf(summary.verdict);
  summary.story = storyOf(report, figures);
  return summary;
}

}  // namespace oikos::mapping
