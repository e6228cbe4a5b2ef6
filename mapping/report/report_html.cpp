// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/base/degrees.h"
#include "mapping/report/figures.h"
#include "mapping/report/frame_plot.h"
#include "mapping/report/html.h"
#include "mapping/report/map_figure.h"
#include "mapping/report/report.h"
#include "mapping/report/style_sheet.h"
#include "mapping/report/summary.h"
#include "mapping/report/text.h"

namespace oikos::mapping {

namespace {

constexpr std::size_t kMaxRows = 200;  ///< of a table; report.json holds all

/// Text from anywhere; nothing reaches the page unescaped but through here or from this folder's own words.
std::string element(const std::string& name, const std::string& style_class, const std::string& text) {
  return "<" + name + (style_class.empty() ? "" : " class=\"" + style_class + "\"") + ">" + escapeHtml(text) + "</" + name + ">";
}

std::string section(const std::string& title, const std::string& content) {
  return "<section>\n" + element("h2", "", title) + "\n" + content + "</section>\n";
}

std::string verdictSection(const MapSummary& summary) {
  std::string html = "<section class=\"verdict " + std::string(base::toString(summary.verdict)) + "\">\n" +
                     element("h2", "", summary.headline) + "\n" + element("p", "", summary.story) + "\n";
  std::string items;
  for (const Finding& finding : summary.findings) {
    items += "<li class=\"" + std::string(base::toString(finding.weight)) + "\">" + escapeHtml(finding.what) + " " +
             element("span", "advice", finding.advice) + "</li>\n";
  }
  return html + (items.empty() ? "" : "<ul>\n" + items + "</ul>\n") + "</section>\n";
}

std::string tile(const std::string& value, const std::string& meaning) {
  return "<div class=\"figure\">" + element("b", "", value) + element("span", "", meaning) + "</div>\n";
}

std::string tiles(const MapReport& report, const ReportFigures& figures) {
  const bool floor_found = report.floor.status == FloorSighting::kFound;
  return "<div class=\"figures\">\n" + tile(shareText(figures.frames - figures.lost, figures.frames), "of the frames have a place") +
         tile(lengthText(figures.path_m), "of path in " + numberText(figures.drive_s, 0) + " s") +
         tile(countText(figures.loops_accepted), "loops closed") +
         tile(report.trajectory_before_loops.empty() ? "–" : lengthText(figures.largest_correction_m), "largest correction by loops") +
         tile(numberText(figures.median_residual_px, 2) + " px", "residual, median frame") +
         tile(floor_found ? numberText(figures.free_area_m2, 1) + " m²" : "–", "of floor known free") + "</div>\n";
}

std::string key(const std::string& style_class, const std::string& text) {
  return "<span><i class=\"" + style_class + "\"></i>" + escapeHtml(text) + "</span>\n";
}

std::string mapSection(const MapReport& report, const ReportFigures& figures) {
  std::string legend = key("key-after", report.trajectory_before_loops.empty() ? "path" : "path after loop closure");
  legend += report.trajectory_before_loops.empty() ? "" : key("key-before", "before");
  legend += report.extension ? key("key-earlier", "earlier drives") : "";
  legend += report.extension && !report.extension->changes.empty() ? key("box key-new", "new") + key("box key-gone", "gone") : "";
  legend += figures.loops_accepted > 0 ? key("key-loop", "loop closed") : "";
  legend += figures.loops_accepted < static_cast<int>(report.loops.size()) ? key("dash key-refused", "loop refused") : "";
  legend += key("box dot key-start", "start") + key("box key-end", "end");
  legend += report.grid.cells.empty() ? "" : key("box key-occupied", "occupied") + key("box key-free", "known free");
  legend += report.plan ? key("key-plan", "floor plan") : "";
  return section("Map from above", mapFigure(report) + "<div class=\"legend\">\n" + legend + "</div>\n");
}

std::string plotsSection(const MapReport& report) {
  FramePlot inliers{"Inliers of each frame over time", "inliers", "inliers", {}};
  FramePlot residuals{"Residual of each frame over time", "residual, px", "residual", {}};
  for (const FrameFacts& frame : report.frames) {
    inliers.values.push_back(frame.inliers);
    residuals.values.push_back(frame.inliers > 0 ? frame.residual_px : std::numeric_limits<double>::quiet_NaN());
  }
  const std::string legend = key("box key-tracked", "tracked") + key("box key-relocalised", "found again") +
                             key("box key-carried", "carried by odometry") + key("box key-lost", "lost");
  return section("Tracking, frame by frame", framePlot(report, inliers) + framePlot(report, residuals) + "<div class=\"legend\">\n" +
                                                 legend +
                                                 "</div>\n<p class=\"note\">Line: middle of the frames drawn together; band: least to "
                                                 "greatest. The strip below each plot shows how frames got their poses.</p>\n");
}

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string factTable(const Rows& rows) {
  std::string html = "<table>\n";
  for (const auto& [name, value] : rows) {
    html += "<tr>" + element("th", "", name) + element("td", "number", value) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string recordingSection(const RecordingFacts& recording) {
  const camera::PinholeCamera& camera = recording.camera;
  return section("Recording", factTable({{"format", recording.format},
                                         {"frames listed", countText(recording.frames_listed)},
                                         {"frames read", countText(recording.frames_read)},
                                         {"unreadable, skipped", countText(recording.skipped)},
                                         {"colour without depth", countText(recording.unmatched)},
                                         {"repeated stamps", countText(recording.duplicates)},
                                         {"camera", countText(camera.width) + " × " + countText(camera.height) + " px"},
                                         {"focal length", numberText(camera.fx, 1) + " / " + numberText(camera.fy, 1) + " px"},
                                         {"principal point", numberText(camera.cx, 1) + " / " + numberText(camera.cy, 1) + " px"}}));
}

std::string trackingSection(const MapReport& report, const ReportFigures& figures) {
  return section("Tracking", factTable({{"tracked", countText(figures.tracked)},
                                        {"found again", countText(figures.relocalised)},
                                        {"carried by odometry", countText(figures.carried)},
                                        {"lost", countText(figures.lost)},
                                        {"keyframes", countText(figures.keyframes)},
                                        {"pieces, joined of all", countText(report.submaps_joined) + " of " + countText(report.submaps)},
                                        {"relocalisations", countText(report.relocalisations)},
                                        {"inliers, median frame", numberText(figures.median_inliers, 0)},
                                        {"residual, median frame", numberText(figures.median_residual_px, 2) + " px"}}));
}

std::string volumeSection(const MapReport& report) {
  const VolumeFacts& volume = report.volume;
  const Eigen::Vector3d size_m = volume.box_max_m - volume.box_min_m;
  const bool floor_found = report.floor.status == FloorSighting::kFound;
  return section("Map", factTable({{"resolution", lengthText(volume.resolution_m)},
                                   {"voxels occupied", countText(volume.voxels_occupied)},
                                   {"voxels free", countText(volume.voxels_free)},
                                   {"grid cells occupied", countText(volume.cells_occupied)},
                                   {"grid cells free", countText(volume.cells_free)},
                                   {"cloud points", countText(volume.cloud_points)},
                                   {"mesh triangles", countText(volume.mesh_triangles)},
                                   {"extent x × y × z", numberText(size_m.x(), 2) + " × " + numberText(size_m.y(), 2) + " × " +
                                                            numberText(size_m.z(), 2) + " m"},
                                   {"camera over floor", floor_found ? lengthText(report.floor.camera_height_m) : "floor not in sight"}}));
}

std::string percentText(double share) {
  return numberText(100.0 * share, 0) + " %";
}

std::string planSection(const std::optional<PlanFacts>& plan) {
  if (!plan) {
    return "";
  }
  const auto degrees = [](const Eigen::Isometry2d& T) {
    return numberText(std::atan2(T.linear()(1, 0), T.linear()(0, 0)) / base::kRadPerDeg, 1) + "°";
  };
  const auto place = [](const Eigen::Isometry2d& T) {
    return numberText(T.translation().x(), 3) + " / " + numberText(T.translation().y(), 3) + " m";
  };
  return section("Floor plan", factTable({{"origin of the map in the plan, x / y", place(plan->T_plan_map)},
                                          {"turn of the map in the plan", degrees(plan->T_plan_map)},
                                          {"start in the map, x / y", place(plan->T_map_base)},
                                          {"heading at the start", degrees(plan->T_map_base)},
                                          {"walls of the plan", numberText(plan->plan_m, 1) + " m"},
                                          {"of these seen", percentText(plan->supported_share)},
                                          {"upright surface on the plan", percentText(plan->on_plan_share)},
                                          {"residual, root mean square", numberText(1000.0 * plan->rms_m, 1) + " mm"},
                                          {"walls over open floor", numberText(plan->crossed_m, 1) + " m"},
                                          {"walls missing", numberText(plan->missing_m, 1) + " m"},
                                          {"floor where the plan has no room", numberText(plan->floor_outside_m2, 1) + " m²"},
                                          {"surface beyond the plan", percentText(plan->beyond_share)}}));
}

std::string moreRows(std::size_t all) {
  return all <= kMaxRows ? ""
                         : "<p class=\"note\">The first " + countText(kMaxRows) + " of " + countText(static_cast<std::int64_t>(all)) +
                               "; report.json has them all.</p>\n";
}

std::string extensionSection(const MapReport& report, const ReportFigures& figures) {
  if (!report.extension) {
    return "";
  }
  const ExtensionFacts& extension = *report.extension;
  return section("What was extended",
                 factTable({{"earlier drives", countText(static_cast<std::int64_t>(report.drives.size()) - 1)},
                            {"their frames", countText(static_cast<std::int64_t>(extension.trajectory.size()))},
                            {"their keyframes", countText(extension.keyframes)},
                            {"loops into them", countText(figures.loops_to_earlier)},
                            {"new keyframes that show changes", countText(extension.witnesses)},
                            {"an earlier keyframe moved by up to", numberText(1000.0 * extension.largest_move_m, 1) + " mm"}}));
}

std::string changesSection(const std::optional<ExtensionFacts>& extension) {
  if (!extension) {
    return "";
  }
  if (extension->changes.empty()) {
    return section("What has changed", "<p>Nothing that is large enough to be told from errors of the map.</p>\n");
  }
  std::string html =
      "<div class=\"scroll\"><table>\n<tr><th>kind</th><th class=\"number\">centre x, y, z, m</th>"
      "<th class=\"number\">size, m</th><th class=\"number\">confidence</th><th>of</th></tr>\n";
  const auto three = [](const Eigen::Vector3d& v) {
    return numberText(v.x(), 2) + ", " + numberText(v.y(), 2) + ", " + numberText(v.z(), 2);
  };
  for (std::size_t i = 0; i < extension->changes.size() && i < kMaxRows; ++i) {
    const Change& change = extension->changes[i];
    html += "<tr>" + element("td", "text", std::string(base::toString(change.kind))) + element("td", "number", three(change.center_map)) +
            element("td", "number", three(change.size_m)) + element("td", "number", numberText(change.confidence, 2)) +
            element("td", "text", i < extension->explanation.pieces.size() ? extension->explanation.pieces[i] : "") + "</tr>\n";
  }
  html += "</table></div>\n" + moreRows(extension->changes.size());
  for (const MovedPieceFacts& piece : extension->explanation.moved) {
    const Eigen::Vector3d to = piece.T_map_after.translation();
    html += element("p", "",
                    piece.id + " stands " + lengthText((to - piece.T_map_before.translation()).norm()) +
                        " from where the home has it, at " + numberText(to.x(), 2) + ", " + numberText(to.y(), 2) + ".") +
            "\n";
  }
  return section("What has changed", html);
}

std::string optimisationSection(const OptimisationFacts& optimisation) {
  std::string html = factTable({{"cost before", numberText(optimisation.initial_cost, 1)},
                                {"cost after", numberText(optimisation.final_cost, 1)},
                                {"iterations", countText(optimisation.iterations)},
                                {"settled", optimisation.converged ? "yes" : "no"}});
  if (!optimisation.refined.empty()) {
    html += "<table>\n<tr><th>calibration</th><th class=\"number\">before</th><th class=\"number\">after</th></tr>\n";
    for (const RefinedValue& value : optimisation.refined) {
      html += "<tr>" + element("th", "", value.name) + element("td", "number", numberText(value.before, 6)) +
              element("td", "number", numberText(value.after, 6)) + "</tr>\n";
    }
    html += "</table>\n";
  }
  return section("Optimisation", html);
}

std::string verdictText(LoopVerdict verdict) {
  switch (verdict) {
    case LoopVerdict::kAccepted:
      return "closed";
    case LoopVerdict::kDownWeighted:
      return "found wrong by the optimiser";
    case LoopVerdict::kRejectedByGeometry:
      return "refused: geometry does not agree";
    case LoopVerdict::kRejectedByConsistency:
      return "refused: contradicts other loops";
  }
  return "";
}

std::string loopsSection(const std::vector<LoopFacts>& loops) {
  if (loops.empty()) {
    return "";
  }
  std::string html =
      "<div class=\"scroll\"><table>\n<tr><th class=\"number\">frame</th><th class=\"number\">saw again</th>"
      "<th class=\"number\">inliers</th><th class=\"number\">residual, px</th><th>what became of it</th></tr>\n";
  for (std::size_t i = 0; i < loops.size() && i < kMaxRows; ++i) {
    const LoopFacts& loop = loops[i];
    html += "<tr>" + element("td", "number", countText(loop.from_frame)) + element("td", "number", countText(loop.to_frame)) +
            element("td", "number", countText(loop.inliers)) + element("td", "number", numberText(loop.residual_px, 2)) +
            element("td", "text", verdictText(loop.verdict)) + "</tr>\n";
  }
  return section("Loops", html + "</table></div>\n" + moreRows(loops.size()));
}

std::string skippedSection(const std::vector<SkippedFrame>& messages) {
  if (messages.empty()) {
    return section("What was skipped", "<p>Nothing: every frame of the recording was used.</p>\n");
  }
  std::string html = "<div class=\"scroll\"><table>\n<tr><th>where</th><th>why</th></tr>\n";
  for (std::size_t i = 0; i < messages.size() && i < kMaxRows; ++i) {
    html += "<tr>" + element("td", "text", messages[i].name) + element("td", "text", messages[i].reason) + "</tr>\n";
  }
  return section("What was skipped", html + "</table></div>\n" + moreRows(messages.size()));
}

std::string warningsSection(const std::vector<std::string>& warnings) {
  if (warnings.empty()) {
    return "";
  }
  std::string html = "<ul>\n";
  for (const std::string& warning : warnings) {
    html += element("li", "", warning) + "\n";
  }
  return section("Warnings", html + "</ul>\n");
}

std::string page(const std::string& content) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>Map report</title>\n<style>" +
         std::string(reportStyleSheet()) + "</style>\n</head>\n<body>\n<main>\n<h1>Oikos · map report</h1>\n" + content +
         "</main>\n</body>\n</html>\n";
}

}  // namespace

std::string reportHtml(const MapReport& report) {
  const ReportFigures figures = figuresOf(report);
  std::string html = verdictSection(summarise(report, figures));
  html += tiles(report, figures);
  html += warningsSection(report.warnings);
  html += mapSection(report, figures);
  html += report.frames.empty() ? "" : plotsSection(report);
  html += "<div class=\"columns\">\n" + recordingSection(report.recording) + trackingSection(report, figures) + volumeSection(report) +
          extensionSection(report, figures) + planSection(report.plan) + optimisationSection(report.optimisation) + "</div>\n";
  html += changesSection(report.extension);
  html += loopsSection(report.loops) + skippedSection(report.recording.messages);
  return page(html);
}

}  // namespace oikos::mapping
