// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/recording/inspect/inspection.h"

namespace oikos::recording {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

const char* name(Verdict verdict) {
  return verdict == Verdict::kGood ? "good" : verdict == Verdict::kUsable ? "usable" : "bad";
}

const char* name(Severity severity) {
  return severity == Severity::kFault ? "fault" : severity == Severity::kWarning ? "warning" : "note";
}

std::string rounded(double value, int decimals) {
  const auto unit = static_cast<std::int64_t>(std::lround(std::pow(10.0, decimals)));
  const std::int64_t scaled = std::llround(std::abs(value) * static_cast<double>(unit));
  std::string text(value < 0.0 && scaled > 0 ? 1 : 0, '-');
  text += std::to_string(scaled / unit);
  if (decimals > 0) {
    const std::string fraction = std::to_string(scaled % unit);
    text.append(1, '.').append(static_cast<std::size_t>(decimals) - fraction.size(), '0').append(fraction);
  }
  return text;
}

class TextReport {
 public:
  void line(const std::string& label, const std::string& value) {
    constexpr std::size_t kLabelWidth = 14;
    text_ += text_.empty() ? "" : "\n";
    text_.append(label).append(kLabelWidth - std::min(kLabelWidth - 1, label.size()), ' ').append(value);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string edgeText(const EdgeReport& edges) {
  if (!edges.is_known_u && !edges.is_known_v) {
    return "too few to tell";
  }
  return "off by " + (edges.is_known_u ? rounded(edges.shift_u_px, 1) : "?") + " px across, " +
         (edges.is_known_v ? rounded(edges.shift_v_px, 1) : "?") + " px down";
}

std::string floorText(const Inspection& inspection) {
  const FloorReport& floor = inspection.floor;
  if (!floor.is_seen) {
    return "not in sight";
  }
  return "in sight in " + std::to_string(floor.frames) + " of " + std::to_string(inspection.geometry_frames) + " frames, camera " +
         rounded(floor.camera_height_m, 2) + " m above it, pitch " + rounded(floor.camera_pitch_rad * kDegrees, 0) + " deg";
}

}  // namespace

std::string toText(const Inspection& inspection) {
  const RateReport& rate = inspection.rate;
  TextReport report;
  report.line("verdict", name(inspection.verdict));
  report.line("frames", std::to_string(inspection.frames) + " (" + std::to_string(inspection.inspected) + " looked at, " +
                            std::to_string(inspection.unreadable) + " unreadable), " + rounded(rate.length_s, 1) + " s");
  report.line("rate", rounded(rate.rate_hz, 1) + " Hz, " + std::to_string(rate.lost) + " lost, longest gap " +
                          rounded(rate.longest_gap_s, 2) + " s");
  report.line("blurred", std::to_string(inspection.blurred.size()) + " of " + std::to_string(inspection.inspected));
  report.line("turning", rounded(inspection.motion.median_rad_s * kDegrees, 0) + " deg/s, fast parts " +
                             rounded(inspection.motion.fast_rad_s * kDegrees, 0) + " deg/s");
  report.line("valid depth", rounded(100.0 * inspection.valid_depth_share, 0) + " %");
  report.line("depth edges", edgeText(inspection.edges));
  report.line("floor", floorText(inspection));
  for (const Finding& finding : inspection.findings) {
    report.line(name(finding.severity), finding.what + ": " + finding.advice);
  }
  return report.text();
}

std::string toJson(const Inspection& inspection) {
  nlohmann::ordered_json json;
  json["verdict"] = name(inspection.verdict);
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : inspection.findings) {
    json["findings"].push_back({{"severity", name(finding.severity)}, {"what", finding.what}, {"advice", finding.advice}});
  }
  const ListingStatistics& listing = inspection.listing;
  json["listing"] = {{"color", listing.listed_color},
                     {"depth", listing.listed_depth},
                     {"duplicateColor", listing.duplicate_color},
                     {"duplicateDepth", listing.duplicate_depth},
                     {"unmatchedColor", listing.unmatched_color},
                     {"unmatchedDepth", listing.unmatched_depth}};
  json["frames"] = inspection.frames;
  json["inspected"] = inspection.inspected;
  json["unreadable"] = inspection.unreadable;
  json["messages"] = inspection.first_messages;
  json["rate"] = {{"rate_hz", inspection.rate.rate_hz},
                  {"length_s", inspection.rate.length_s},
                  {"lost", inspection.rate.lost},
                  {"longestGap_s", inspection.rate.longest_gap_s}};
  json["blurred"] = nlohmann::ordered_json::array();
  for (const BlurredFrame& frame : inspection.blurred) {
    json["blurred"].push_back({{"frame", frame.index}, {"reason", frame.reason}});
  }
  json["motion"] = {{"median_deg_s", inspection.motion.median_rad_s * kDegrees}, {"fast_deg_s", inspection.motion.fast_rad_s * kDegrees}};
  json["validDepthShare"] = inspection.valid_depth_share;
  const EdgeReport& edges = inspection.edges;
  json["depthEdges"] = {{"shiftU_px", edges.is_known_u ? nlohmann::ordered_json(edges.shift_u_px) : nullptr},
                        {"shiftV_px", edges.is_known_v ? nlohmann::ordered_json(edges.shift_v_px) : nullptr},
                        {"edgesU", edges.edges_u},
                        {"edgesV", edges.edges_v}};
  const FloorReport& floor = inspection.floor;
  json["floor"] = {{"seen", floor.is_seen}, {"frames", floor.frames}, {"of", inspection.geometry_frames}};
  if (floor.is_seen) {
    json["floor"]["cameraHeight_m"] = floor.camera_height_m;
    json["floor"]["cameraPitch_deg"] = floor.camera_pitch_rad * kDegrees;
  }
  return json.dump(2);
}

}  // namespace oikos::recording
