// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/degrees.h"
#include "mapping/report/figures.h"
#include "mapping/report/json_text.h"
#include "mapping/report/report.h"
#include "mapping/report/summary.h"

namespace oikos::mapping {

namespace {

using Json = nlohmann::ordered_json;

Json vectorJson(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json summaryJson(const MapSummary& summary) {
  Json findings = Json::array();
  for (const Finding& finding : summary.findings) {
    findings.push_back({{"weight", base::toString(finding.weight)}, {"what", finding.what}, {"advice", finding.advice}});
  }
  return {{"verdict", base::toString(summary.verdict)},
          {"headline", summary.headline},
          {"story", summary.story},
          {"findings", std::move(findings)}};
}

Json recordingJson(const RecordingFacts& recording) {
  Json messages = Json::array();
  for (const SkippedFrame& frame : recording.messages) {
    messages.push_back({{"name", frame.name}, {"reason", frame.reason}});
  }
  const camera::PinholeCamera& camera = recording.camera;
  return {{"format", recording.format},
          {"frames_listed", recording.frames_listed},
          {"frames_read", recording.frames_read},
          {"frames_skipped", recording.skipped},
          {"frames_unmatched", recording.unmatched},
          {"frames_duplicate", recording.duplicates},
          {"messages", std::move(messages)},
          {"camera",
           {{"width_px", camera.width},
            {"height_px", camera.height},
            {"fx_px", camera.fx},
            {"fy_px", camera.fy},
            {"cx_px", camera.cx},
            {"cy_px", camera.cy}}}};
}

Json trackingJson(const MapReport& report, const ReportFigures& figures) {
  return {{"frames", figures.frames},
          {"tracked", figures.tracked},
          {"relocalised", figures.relocalised},
          {"carried", figures.carried},
          {"lost", figures.lost},
          {"keyframes", figures.keyframes},
          {"submaps", report.submaps},
          {"submaps_joined", report.submaps_joined},
          {"relocalisations", report.relocalisations},
          {"drive_s", figures.drive_s},
          {"path_m", figures.path_m},
          {"median_inliers", figures.median_inliers},
          {"median_residual_px", figures.median_residual_px}};
}

Json loopsJson(const MapReport& report, const ReportFigures& figures) {
  Json list = Json::array();
  for (const LoopFacts& loop : report.loops) {
    list.push_back({{"from_frame", loop.from_frame},
                    {loop.is_to_earlier_drive ? "to_earlier_frame" : "to_frame", loop.to_frame},
                    {"inliers", loop.inliers},
                    {"residual_px", loop.residual_px},
                    {"verdict", base::toString(loop.verdict)}});
  }
  return {{"accepted", figures.loops_accepted},
          {"to_earlier_drives", figures.loops_to_earlier},
          {"down_weighted", figures.loops_down_weighted},
          {"rejected", figures.loops_rejected},
          {"largest_correction_m", figures.largest_correction_m},
          {"list", std::move(list)}};
}

Json optimisationJson(const OptimisationFacts& optimisation) {
  Json refined = Json::array();
  for (const RefinedValue& value : optimisation.refined) {
    refined.push_back({{"name", value.name}, {"before", value.before}, {"after", value.after}});
  }
  return {{"initial_cost", optimisation.initial_cost},
          {"final_cost", optimisation.final_cost},
          {"iterations", optimisation.iterations},
          {"converged", optimisation.converged},
          {"refined", std::move(refined)}};
}

Json floorJson(const FloorFacts& floor) {
  Json json = {{"status", base::toString(floor.status)}};
  json["camera_height_m"] = floor.status == FloorSighting::kFound ? Json(floor.camera_height_m) : Json(nullptr);
  return json;
}

Json floorPoseJson(const Eigen::Isometry2d& T) {
  const double yaw_rad = std::atan2(T.linear()(1, 0), T.linear()(0, 0));
  return {{"x_m", T.translation().x()}, {"y_m", T.translation().y()}, {"yaw_deg", yaw_rad / base::kRadPerDeg}};
}

Json planJson(const PlanFacts& plan) {
  return {{"map_in_plan", floorPoseJson(plan.T_plan_map)},
          {"start_in_map", floorPoseJson(plan.T_map_base)},
          {"plan_walls_m", plan.plan_m},
          {"plan_walls_seen_share", plan.supported_share},
          {"upright_surface_on_plan_share", plan.on_plan_share},
          {"residual_rms_m", plan.rms_m},
          {"walls_over_floor_m", plan.crossed_m},
          {"walls_missing_m", plan.missing_m},
          {"floor_outside_m2", plan.floor_outside_m2},
          {"surface_beyond_share", plan.beyond_share}};
}

Json drivesJson(const std::vector<DriveFacts>& drives) {
  Json list = Json::array();
  for (const DriveFacts& drive : drives) {
    list.push_back({{"first_frame", drive.first_frame}, {"frames", drive.frames}, {"added_to_stamps_s", drive.added_to_stamps_s}});
  }
  return list;
}

Json extensionJson(const ExtensionFacts& extension) {
  return {{"earlier_frames", extension.trajectory.size()},
          {"earlier_keyframes", extension.keyframes},
          {"keyframes_of_changes", extension.witnesses},
          {"largest_move_m", extension.largest_move_m}};
}

Json movedJson(const std::vector<MovedPieceFacts>& pieces) {
  const auto pose = [](const Eigen::Isometry3d& T) {
    const double yaw_rad = std::atan2(T.linear()(1, 0), T.linear()(0, 0));
    return Json{
        {"x_m", T.translation().x()}, {"y_m", T.translation().y()}, {"z_m", T.translation().z()}, {"yaw_deg", yaw_rad / base::kRadPerDeg}};
  };
  Json list = Json::array();
  for (const MovedPieceFacts& piece : pieces) {
    list.push_back({{"id", piece.id},
                    {"before_map", pose(piece.T_map_before)},
                    {"after_map", pose(piece.T_map_after)},
                    {"views", piece.views},
                    {"spread_m", piece.spread_m}});
  }
  return list;
}

Json changesJson(const ExtensionFacts& extension) {
  Json list = Json::array();
  for (std::size_t i = 0; i < extension.changes.size(); ++i) {
    const Change& change = extension.changes[i];
    const std::string piece = i < extension.explanation.pieces.size() ? extension.explanation.pieces[i] : "";
    Json entry = {
        {"kind", base::toString(change.kind)}, {"center_map_m", vectorJson(change.center_map)}, {"size_m", vectorJson(change.size_m)}};
    entry["support_height_m"] = change.support_height_m ? Json(*change.support_height_m) : Json(nullptr);
    entry["confidence"] = change.confidence;
    entry["piece"] = piece.empty() ? Json(nullptr) : Json(piece);
    list.push_back(std::move(entry));
  }
  return list;
}

Json volumeJson(const VolumeFacts& volume, const ReportFigures& figures) {
  return {{"resolution_m", volume.resolution_m},       {"voxels_occupied", volume.voxels_occupied},
          {"voxels_free", volume.voxels_free},         {"cells_occupied", volume.cells_occupied},
          {"cells_free", volume.cells_free},           {"free_area_m2", figures.free_area_m2},
          {"cloud_points", volume.cloud_points},       {"mesh_triangles", volume.mesh_triangles},
          {"box_min_m", vectorJson(volume.box_min_m)}, {"box_max_m", vectorJson(volume.box_max_m)}};
}

Json positionJson(const recording::Trajectory& trajectory, std::size_t i) {
  return i < trajectory.size() ? vectorJson(trajectory[i].T_map_camera.translation()) : Json(nullptr);
}

/// One row a frame: a table that is short to write and loads into any program for tables.
Json framesJson(const MapReport& report) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < report.frames.size(); ++i) {
    const FrameFacts& frame = report.frames[i];
    const auto since_start_ns = static_cast<double>(report.trajectory[i].stamp_ns - report.trajectory.front().stamp_ns);
    rows.push_back({since_start_ns * 1e-9, base::toString(frame.status), frame.inliers, frame.residual_px, frame.is_keyframe,
                    positionJson(report.trajectory, i), positionJson(report.trajectory_before_loops, i)});
  }
  return {
      {"columns", {"since_start_s", "status", "inliers", "residual_px", "is_keyframe", "position_map_m", "position_before_loops_map_m"}},
      {"rows", std::move(rows)}};
}

}  // namespace

std::string reportJson(const MapReport& report) {
  const ReportFigures figures = figuresOf(report);
  Json json = {{"format", "oikos-map-report"}, {"version", 1}};
  json["summary"] = summaryJson(summarise(report, figures));
  json["warnings"] = report.warnings;
  json["recording"] = recordingJson(report.recording);
  json["tracking"] = trackingJson(report, figures);
  json["loops"] = loopsJson(report, figures);
  json["optimisation"] = optimisationJson(report.optimisation);
  json["floor"] = floorJson(report.floor);
  if (report.plan) {
    json["floor_plan"] = planJson(*report.plan);
  }
  json["drives"] = drivesJson(report.drives);
  if (report.extension) {
    json["extension"] = extensionJson(*report.extension);
    json["changes"] = changesJson(*report.extension);
    json["moved_furniture"] = movedJson(report.extension->explanation.moved);
  }
  json["map"] = volumeJson(report.volume, figures);
  json["frames"] = framesJson(report);
  return jsonText(json);
}

}  // namespace oikos::mapping
