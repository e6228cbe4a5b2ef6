// SPDX-License-Identifier: Apache-2.0
#include "mapping/map_report.h"

#include <limits>
#include <map>
#include <set>

namespace oikos::mapping {

namespace {

RecordingFacts recordingFacts(const MapFacts& facts) {
  RecordingFacts r;
  r.format = facts.recording.format();
  r.frames_listed = facts.statistics.listed;
  r.frames_read = facts.statistics.read;
  r.skipped = facts.statistics.unreadable;
  r.unmatched = facts.statistics.listing.unmatched_color;
  r.duplicates = facts.statistics.listing.duplicate_color;
  for (const std::string& message : facts.statistics.first_messages) {
    r.messages.push_back({"", message});
  }
  r.camera = facts.recording.camera();
  return r;
}

FrameStatus statusOf(const TrackedFrame& frame, bool carried) {
  switch (frame.status) {
    case TrackingStatus::kTracked:
    case TrackingStatus::kStart:
      return FrameStatus::kTracked;
    case TrackingStatus::kRelocalised:
      return FrameStatus::kRelocalised;
    case TrackingStatus::kLost:
      break;
  }
  return carried ? FrameStatus::kCarried : FrameStatus::kLost;
}

void addFrames(const MapFacts& facts, MapReport& report) {
  std::set<int> keyframes;
  for (const Node& node : facts.drive.graph.nodes) {
    if (node.keyframe) {
      keyframes.insert(node.frame);
    }
  }
  for (std::size_t i = 0; i < facts.drive.frames.size(); ++i) {
    const TrackedFrame& frame = facts.drive.frames[i];
    FrameFacts f;
    f.status = statusOf(frame, facts.carried[i] != 0);
    f.inliers = frame.inliers;
    f.residual_px = frame.inliers == 0 ? std::numeric_limits<double>::quiet_NaN() : frame.rms_px;
    f.is_keyframe = keyframes.contains(frame.frame);
    report.frames.push_back(f);
    report.trajectory.push_back({frame.stamp_ns, facts.optimised.T_world_frame[i]});
    // Both begin at the same pose: what differs is drift.
    const Eigen::Isometry3d T_map_odometry =
        facts.optimised.T_world_frame.front() * facts.optimised.T_world_frame_odometry.front().inverse();
    report.trajectory_before_loops.push_back({frame.stamp_ns, T_map_odometry * facts.optimised.T_world_frame_odometry[i]});
  }
}

/// `position` of this drive's frames; earlier ones are their own.
LoopFacts loopBetween(const KeyframeGraph& graph, int old_node, int frame, const std::map<int, int>& position) {
  LoopFacts loop;
  loop.from_frame = position.at(frame);
  loop.is_to_earlier_drive = old_node < graph.settled;
  const int old_frame = graph.nodes[static_cast<std::size_t>(old_node)].frame;
  loop.to_frame = loop.is_to_earlier_drive ? old_frame : position.at(old_frame);
  return loop;
}

/// Accepted attempts are edges, in the same order; the others failed by geometry.
void addLoops(const MapFacts& facts, MapReport& report) {
  std::map<int, int> position;
  for (std::size_t i = 0; i < facts.drive.frames.size(); ++i) {
    position[facts.drive.frames[i].frame] = static_cast<int>(i);
  }
  const KeyframeGraph& graph = facts.drive.graph;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Edge& edge = graph.edges[e];
    if (edge.kind != EdgeKind::kLoop) {
      continue;
    }
    LoopFacts loop = loopBetween(graph, edge.from, graph.nodes[static_cast<std::size_t>(edge.to)].frame, position);
    loop.inliers = edge.inliers;
    loop.residual_px = edge.rms_px;
    constexpr double kDownWeighted = 0.25;
    loop.verdict = facts.optimised.believed[e] == 0                            ? LoopVerdict::kRejectedByConsistency
                   : facts.optimised.pose_graph.loop_weight[e] < kDownWeighted ? LoopVerdict::kDownWeighted
                                                                               : LoopVerdict::kAccepted;
    report.loops.push_back(loop);
  }
  for (const LoopAttempt& attempt : facts.drive.loop_attempts) {
    if (attempt.verdict == LoopCheck::kGeometryDisagrees || attempt.verdict == LoopCheck::kWheelsDisagree) {
      LoopFacts& loop = report.loops.emplace_back(loopBetween(graph, attempt.from, attempt.frame, position));
      loop.inliers = attempt.inliers;
      loop.residual_px = attempt.rms_px;
    }
  }
}

OptimisationFacts optimisationFacts(const BackEndResult& optimised) {
  OptimisationFacts o;
  const bool bundle = optimised.bundle.usable;
  o.initial_cost = bundle ? optimised.bundle.initial_cost : optimised.pose_graph.initial_cost;
  o.final_cost = bundle ? optimised.bundle.final_cost : optimised.pose_graph.final_cost;
  o.iterations = bundle ? optimised.bundle.iterations : optimised.pose_graph.iterations;
  o.converged = bundle || optimised.pose_graph.usable;
  if (optimised.readout_s != 0.0) {
    o.refined.push_back({"rolling_shutter_readout_s", 0.0, optimised.readout_s});
  }
  return o;
}

VolumeFacts volumeFacts(const MapFacts& facts) {
  VolumeFacts v;
  v.resolution_m = facts.volume.occupancy.resolution_m;
  v.voxels_occupied = facts.fused.voxels_occupied;
  v.voxels_free = facts.fused.voxels_free;
  for (const Cell cell : facts.fused.grid.cells) {
    v.cells_occupied += cell == Cell::kOccupied ? 1 : 0;
    v.cells_free += cell == Cell::kFree ? 1 : 0;
  }
  v.cloud_points = facts.fused.cloud_points;
  v.mesh_triangles = facts.fused.mesh_triangles;
  v.box_min_m = facts.fused.box_min_map;
  v.box_max_m = facts.fused.box_max_map;
  return v;
}

PlanFacts planFacts(const PlanPlacement& placement) {
  PlanFacts facts;
  const PlanFigures& figures = placement.fit.figures;
  facts.T_plan_map = placement.T_plan_map;
  facts.T_map_base = placement.T_map_base;
  facts.plan_m = figures.plan_m;
  facts.supported_share = figures.supported_share;
  facts.on_plan_share = figures.on_plan_share;
  facts.rms_m = figures.rms_m;
  facts.crossed_m = figures.crossed_m;
  facts.missing_m = figures.missing_m;
  facts.floor_outside_m2 = figures.floor_outside_m2;
  facts.beyond_share = figures.beyond_share;
  const Eigen::Isometry2d T_map_plan = placement.T_plan_map.inverse();
  for (const PlanLine& line : placement.plan.lines) {
    facts.lines_map.push_back({T_map_plan * line.from_plan, T_map_plan * line.to_plan});
  }
  return facts;
}

GridPicture gridPicture(const OccupancyGrid& grid) {
  GridPicture picture;
  picture.resolution_m = grid.resolution_m;
  picture.origin_m = grid.corner_map;
  picture.cells = cv::Mat(grid.height, grid.width, CV_8UC1);
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      picture.cells.at<std::uint8_t>(grid.height - 1 - row, column) = static_cast<std::uint8_t>(grid.at(column, row));
    }
  }
  return picture;
}

}  // namespace

MapReport makeReport(const MapFacts& facts) {
  MapReport report;
  report.recording = recordingFacts(facts);
  addFrames(facts, report);
  report.submaps = facts.drive.submaps;
  report.submaps_joined = facts.drive.submaps - facts.optimised.submaps_left + 1;
  report.relocalisations = facts.drive.relocalisations;
  addLoops(facts, report);
  report.optimisation = optimisationFacts(facts.optimised);
  report.floor = {facts.floor.status == FloorStatus::kFound ? FloorSighting::kFound : FloorSighting::kNotInSight,
                  facts.floor.camera_height_m};
  report.volume = volumeFacts(facts);
  if (facts.placement) {
    report.plan = planFacts(*facts.placement);
  }
  report.grid = gridPicture(facts.fused.grid);
  if (facts.odometry_without_mount) {
    report.warnings.emplace_back(
        "odometry.txt was not used: where the camera sits on the robot is not known. Give T_base_camera in camera.toml, or --robot, "
        "--base-link "
        "and --camera-link.");
  }
  return report;
}

}  // namespace oikos::mapping
