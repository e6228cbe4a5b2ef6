// SPDX-License-Identifier: Apache-2.0
#include "core/recording/inspect/inspection.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/recording/inspect/edge_alignment.h"
#include "core/recording/inspect/floor_view.h"
#include "core/recording/inspect/frame_measure.h"
#include "core/recording/inspect/verdict.h"

namespace oikos::recording {

namespace {

constexpr double kSmeared = 0.45;  // FrameMeasure::blur: the knee between still and moving frames of hand-held Kinect recordings

/// Everything that is kept of one frame.
struct Look {
  int index = -1;
  std::int64_t stamp_ns = 0;
  bool is_readable = false;
  std::string message;
  FrameMeasure measure;
  bool has_geometry = false;
  EdgeProfiles edges{};
  std::optional<FloorView> floor;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// All frames of a short recording; of a long one bursts of consecutive frames, evenly spread.
std::vector<int> chooseFrames(int frames, int max_frames) {
  constexpr int kBurst = 12;
  std::vector<int> chosen;
  const int bursts = std::max(1, max_frames / kBurst);
  for (int i = 0; i < frames; ++i) {
    const std::int64_t burst = static_cast<std::int64_t>(i) * bursts / frames;  // the part of the recording that i lies in
    const std::int64_t first = (burst * frames + bursts - 1) / bursts;
    if (frames <= max_frames || i - first < kBurst) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

Look lookAt(const Recording& recording, int index, bool with_geometry) {
  Look look;
  look.index = index;
  look.stamp_ns = recording.stampNs(index);
  try {
    const camera::RgbdFrame frame = recording.read(index, Channels::kGray);
    look.measure = measureFrame(frame);
    if (with_geometry) {
      look.edges = profileDepthEdges(frame);
      look.floor = findLowestPlane(frame.depth_m, recording.camera(), static_cast<unsigned>(index));
    }
    look.has_geometry = with_geometry;
    look.is_readable = true;
  } catch (const base::Error& error) {
    look.message = error.what();
  }
  return look;
}

std::vector<Look> lookAtFrames(const Recording& recording, const InspectionConfig& config, const base::ProgressSink& progress) {
  const std::vector<int> chosen = chooseFrames(recording.frameCount(), config.max_frames);
  const int count = static_cast<int>(chosen.size());
  const int geometry_step = std::max(1, count / config.geometry_frames);
  std::vector<Look> looks(chosen.size());
  std::atomic<int> done = 0;
  base::parallelFor(count, config.threads, [&](int i) {
    looks[static_cast<std::size_t>(i)] = lookAt(recording, chosen[static_cast<std::size_t>(i)], i % geometry_step == 0);
    base::reportProgress(progress, {"inspecting", ++done, count});
  });
  return looks;
}

RateReport reportRate(const Recording& recording) {
  std::vector<double> intervals_s;
  for (int i = 1; i < recording.frameCount(); ++i) {
    intervals_s.push_back(static_cast<double>(recording.stampNs(i) - recording.stampNs(i - 1)) * 1e-9);
  }
  RateReport rate;
  const double usual_s = quantile(intervals_s, 0.5);
  if (usual_s <= 0.0) {
    return rate;
  }
  rate.rate_hz = 1.0 / usual_s;
  for (const double interval_s : intervals_s) {
    rate.length_s += interval_s;
    rate.longest_gap_s = std::max(rate.longest_gap_s, interval_s);
    rate.lost += interval_s > 1.5 * usual_s ? static_cast<int>(std::lround(interval_s / usual_s)) - 1 : 0;
  }
  return rate;
}

/// Turn rate of each look against the one before it; negative where there is no frame just before.
std::vector<double> turnRates(const std::vector<Look>& looks, const camera::PinholeCamera& camera) {
  std::vector<double> rates(looks.size(), -1.0);
  for (std::size_t i = 1; i < looks.size(); ++i) {
    const Look& from = looks[i - 1];
    const Look& to = looks[i];
    const double interval_s = static_cast<double>(to.stamp_ns - from.stamp_ns) * 1e-9;
    if (from.is_readable && to.is_readable && to.index == from.index + 1 && interval_s > 0.0) {
      rates[i] = imageTurnRad(from.measure, to.measure, camera) / interval_s;
    }
  }
  return rates;
}

MotionReport reportMotion(const std::vector<double>& rates_rad_s) {
  std::vector<double> known;
  std::copy_if(rates_rad_s.begin(), rates_rad_s.end(), std::back_inserter(known), [](double rate) { return rate >= 0.0; });
  return {quantile(known, 0.5), quantile(known, 0.95)};
}

std::vector<BlurredFrame> findBlurred(const std::vector<Look>& looks, const std::vector<double>& rates_rad_s) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  std::vector<BlurredFrame> blurred;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const double blur = looks[i].measure.blur;
    if (!looks[i].is_readable || blur <= kSmeared) {
      continue;
    }
    std::string reason = std::to_string(std::lround(100.0 * blur)) + " % of the fine detail is smeared (sharp pictures: about 30 %)";
    if (rates_rad_s[i] >= 0.0) {
      reason.append(", the image moves at ").append(std::to_string(std::lround(rates_rad_s[i] * kDegrees))).append(" deg/s");
    }
    blurred.push_back({looks[i].index, reason});
  }
  return blurred;
}

EdgeReport reportEdges(const std::vector<Look>& looks) {
  EdgeProfiles sum{};
  for (const Look& look : looks) {
    addProfiles(look.edges, sum);
  }
  const auto profile = [&sum](EdgeSide side) -> const EdgeProfile& { return sum[static_cast<std::size_t>(side)]; };
  const EdgeShift u = findEdgeShift(profile(EdgeSide::kLeft), profile(EdgeSide::kRight));
  const EdgeShift v = findEdgeShift(profile(EdgeSide::kTop), profile(EdgeSide::kBottom));
  return {u.shift_px, v.shift_px, u.edges, v.edges, u.is_known, v.is_known};
}

FloorReport reportFloor(const std::vector<Look>& looks) {
  std::vector<FloorView> views;
  for (const Look& look : looks) {
    if (look.floor) {
      views.push_back(*look.floor);
    }
  }
  const auto shared = agreeOnFloor(std::move(views));
  return shared ? FloorReport{true, shared->view.camera_height_m, shared->view.camera_pitch_rad, shared->frames} : FloorReport{};
}

void countFrames(const std::vector<Look>& looks, Inspection& inspection) {
  constexpr std::size_t kKeptMessages = 10;
  double valid = 0.0;
  for (const Look& look : looks) {
    valid += look.measure.valid_depth_share;
    inspection.geometry_frames += look.has_geometry ? 1 : 0;
    if (!look.is_readable) {
      ++inspection.unreadable;
      if (inspection.first_messages.size() < kKeptMessages) {
        inspection.first_messages.push_back(look.message);
      }
    }
  }
  inspection.inspected = static_cast<int>(looks.size());
  inspection.valid_depth_share = valid / std::max(1, inspection.inspected - inspection.unreadable);
}

}  // namespace

std::vector<std::string> InspectionConfig::validate() const {
  return base::ConfigRules()
      .atLeast("max_frames", max_frames, 2)
      .atLeast("geometry_frames", geometry_frames, 1)
      .atLeast("threads", threads, 1)
      .between("max_blurred_share", max_blurred_share, 0.0, 1.0)
      .greater("max_turn_rate_deg_s", max_turn_rate_deg_s, 0.0)
      .between("min_valid_depth_share", min_valid_depth_share, 0.0, 1.0)
      .greater("max_edge_shift_px", max_edge_shift_px, 0.0)
      .messages();
}

Inspection inspect(const Recording& recording, const InspectionConfig& config, const base::ProgressSink& progress) {
  if (const auto problems = config.validate(); !problems.empty()) {
    throw base::Error(base::ErrorCode::kUsage, problems.front());
  }
  const std::vector<Look> looks = lookAtFrames(recording, config, progress);
  const std::vector<double> rates_rad_s = turnRates(looks, recording.camera());
  Inspection inspection;
  inspection.listing = recording.listing();
  inspection.frames = recording.frameCount();
  countFrames(looks, inspection);
  inspection.rate = reportRate(recording);
  inspection.motion = reportMotion(rates_rad_s);
  inspection.blurred = findBlurred(looks, rates_rad_s);
  inspection.edges = reportEdges(looks);
  inspection.floor = reportFloor(looks);
  inspection.findings = findProblems(inspection, recording, config);
  inspection.verdict = judge(inspection.findings);
  return inspection;
}

}  // namespace oikos::recording
