// SPDX-License-Identifier: Apache-2.0
#include "core/recording/inspect/verdict.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace oikos::recording {

namespace {

std::string fixed(double value, int decimals) {
  std::array<char, 64> buffer{};
  const auto [end, failure] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  return failure == std::errc() ? std::string(buffer.data(), end) : std::string("?");
}

std::string percent(double share) {
  return fixed(100.0 * share, 0) + " %";
}

/// A fault above twice the limit, a warning above it, else nothing.
void addIfAbove(double value, double limit, Finding finding, std::vector<Finding>& findings) {
  if (value > limit) {
    finding.severity = value > 2.0 * limit ? Severity::kFault : Severity::kWarning;
    findings.push_back(std::move(finding));
  }
}

double shareOf(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : 0.0;
}

void judgeFiles(const Inspection& inspection, std::vector<Finding>& findings) {
  constexpr double kTolerated = 0.1;
  const double unreadable = shareOf(inspection.unreadable, inspection.inspected);
  if (inspection.unreadable > 0) {
    findings.push_back({unreadable > 2.0 * kTolerated ? Severity::kFault : Severity::kWarning,
                        std::to_string(inspection.unreadable) + " frames cannot be read; the first: " + inspection.first_messages.front(),
                        "copy the recording again, and check the disk"});
  }
  addIfAbove(shareOf(inspection.listing.unmatched_color, inspection.listing.listed_color), kTolerated,
             {{},
              std::to_string(inspection.listing.unmatched_color) + " colour images have no depth image near in time",
              "check that both streams are recorded with the same clock and rate"},
             findings);
}

void judgeRate(const Inspection& inspection, std::vector<Finding>& findings) {
  constexpr double kSlow_hz = 8.0;
  constexpr double kTooSlow_hz = 4.0;
  constexpr double kTolerated = 0.1;
  const RateReport& rate = inspection.rate;
  if (rate.rate_hz < kSlow_hz) {
    findings.push_back({rate.rate_hz < kTooSlow_hz ? Severity::kFault : Severity::kWarning,
                        "only " + fixed(rate.rate_hz, 1) + " frames a second", "record at 15 frames a second or more, or drive slowly"});
  }
  addIfAbove(shareOf(rate.lost, rate.lost + inspection.frames), kTolerated,
             {{},
              std::to_string(rate.lost) + " frames were lost, the longest gap is " + fixed(rate.longest_gap_s, 2) + " s",
              "record to a faster disk, or at a lower rate or resolution"},
             findings);
}

void judgeMotion(const Inspection& inspection, const InspectionConfig& config, std::vector<Finding>& findings) {
  const double fast_deg_s = inspection.motion.fast_rad_s * 180.0 / std::numbers::pi;
  addIfAbove(fast_deg_s, config.max_turn_rate_deg_s,
             {{},
              "the camera turns at up to " + fixed(fast_deg_s, 0) + " deg/s",
              "turn slower, below " + fixed(config.max_turn_rate_deg_s / 2.0, 0) + " deg/s"},
             findings);
  const double blurred = shareOf(static_cast<int>(inspection.blurred.size()), inspection.inspected);
  addIfAbove(blurred, config.max_blurred_share,
             {{}, percent(blurred) + " of the frames are blurred", "drive and turn slower, or switch on more light for shorter exposures"},
             findings);
}

void judgeDepth(const Inspection& inspection, const InspectionConfig& config, std::vector<Finding>& findings) {
  const double valid = inspection.valid_depth_share;
  if (valid < config.min_valid_depth_share) {
    findings.push_back({valid < 0.4 * config.min_valid_depth_share ? Severity::kFault : Severity::kWarning,
                        "only " + percent(valid) + " of the depth pixels have a reading",
                        "keep 0.5 to 4 m from surfaces, away from sunlight; check depth_scale and that the sensor's window is clean"});
  }
}

void judgeEdges(const Inspection& inspection, const InspectionConfig& config, std::vector<Finding>& findings) {
  const EdgeReport& edges = inspection.edges;
  const double u = edges.is_known_u ? edges.shift_u_px : 0.0;
  const double v = edges.is_known_v ? edges.shift_v_px : 0.0;
  addIfAbove(
      std::hypot(u, v), config.max_edge_shift_px,
      {{},
       "depth edges lie beside the colour edges: they fit best moved by " + fixed(u, 1) + " px across and " + fixed(v, 1) + " px down",
       "calibrate again: T_color_depth and the intrinsics in camera.toml, and whether depth is registered to colour"},
      findings);
  if (!edges.is_known_u && !edges.is_known_v) {
    findings.push_back({Severity::kNote, "too few depth edges to check the calibration by",
                        "record a few seconds of chairs or other things that stand free"});
  }
}

void judgeWhatIsMissing(const Inspection& inspection, const Recording& recording, std::vector<Finding>& findings) {
  if (!inspection.floor.is_seen) {
    findings.push_back(
        {Severity::kNote, "the floor is not in sight", "tilt the camera down: without the floor the map has no height and no 2D grid"});
  }
  if (!recording.T_base_camera()) {
    findings.push_back({Severity::kNote, "the camera's mount on the robot is unknown", "add T_base_camera to camera.toml, or give a URDF"});
  }
  constexpr std::int64_t kLeastUnixStamp_ns = 1'000'000'000'000'000'000;
  if (!recording.startNs() && recording.frameCount() > 0 && recording.stampNs(0) < kLeastUnixStamp_ns) {
    findings.push_back({Severity::kNote, "the time of the recording is unknown", "add start to camera.toml"});
  }
}

}  // namespace

std::vector<Finding> findProblems(const Inspection& inspection, const Recording& recording, const InspectionConfig& config) {
  std::vector<Finding> findings;
  judgeFiles(inspection, findings);
  judgeRate(inspection, findings);
  judgeMotion(inspection, config, findings);
  judgeDepth(inspection, config, findings);
  judgeEdges(inspection, config, findings);
  judgeWhatIsMissing(inspection, recording, findings);
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return findings;
}

Verdict judge(const std::vector<Finding>& findings) {
  Severity worst = Severity::kNote;
  for (const Finding& finding : findings) {
    worst = std::max(worst, finding.severity);
  }
  return worst == Severity::kFault ? Verdict::kBad : worst == Severity::kWarning ? Verdict::kUsable : Verdict::kGood;
}

}  // namespace oikos::recording
