// SPDX-License-Identifier: Apache-2.0
#include "tools/map_home.h"

#include <iostream>

#include "core/base/error.h"
#include "semantic/xml/home_reader.h"
#include "tools/home_plan.h"
#include "tools/home_stage.h"
#include "tools/room_clouds.h"
#include "tools/terminal_progress.h"
#include "tracking/furniture/changed_pieces.h"
#include "tracking/furniture/moved_furniture.h"

namespace oikos::tools {

namespace {

/// A map can be made without a valid home.xml; what is wrong with it is told before the work.
std::optional<semantic::Home> findHome(const std::filesystem::path& home) {
  const std::filesystem::path file = home / "home.xml";
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  try {
    return semantic::getHome(semantic::readHome(file), file);
  } catch (const base::Error& error) {
    std::cerr << "oikos: the rooms get no clouds of their own: " << error.what() << '\n';
    return std::nullopt;
  }
}

/// What of the home's furniture the changes are of, and where what was moved stands now.
mapping::ChangeExplanation explain(const semantic::Home& home, const std::filesystem::path& folder, int threads,
                                   const std::vector<mapping::Change>& changes, const std::vector<mapping::LocatedScan>& scans) {
  mapping::ChangeExplanation explanation;
  explanation.pieces = tracking::piecesOf(changes, home, folder);
  tracking::MovedFurnitureConfig config;
  config.threads = threads;
  for (const tracking::MovedPiece& piece : tracking::findMovedFurniture(home, folder, scans, changes, config)) {
    explanation.moved.push_back({piece.id.value, piece.T_map_before, piece.T_map_after, piece.views, piece.spread_m});
  }
  return explanation;
}

}  // namespace

Eigen::Isometry2d floorPose(const semantic::Pose& pose) {
  return Eigen::Translation2d(pose.position_m.head<2>()) * Eigen::Rotation2Dd(pose.roll_pitch_yaw_rad.z());
}

/// What the map is laid onto: the home's outlines, else the drawing that was given, if any.
std::optional<mapping::PlanTask> planFor(const MapJob& job, const std::optional<semantic::Home>& known) {
  const std::string file = (job.home / "home.xml").string();
  mapping::FloorPlan outlines = known ? planOf(*known) : mapping::FloorPlan{};
  if (outlines.lines.empty()) {
    return job.plan;
  }
  if (job.plan) {
    throw base::Error(base::ErrorCode::kUsage, "has the outlines of its rooms, which the map is laid onto; it needs no --floorplan", file);
  }
  return mapping::PlanTask{std::move(outlines), file, mapping::PlanFrame::kPlan, floorPose(known->T_map_dock)};
}

mapping::MapResult mapIntoHome(const MapJob& job, const Session& session) {
  TerminalProgress progress(session.options);
  const std::optional<semantic::Home> known = findHome(job.home);
  const std::filesystem::path map = job.home / "map";
  if (job.extend && !std::filesystem::exists(map)) {
    throw base::Error(base::ErrorCode::kUsage, "no such map to extend: make one first, without --extend", map.string());
  }
  mapping::ExplainChanges explanation;
  if (job.extend && known) {
    explanation = [&](const std::vector<mapping::Change>& changes, const std::vector<mapping::LocatedScan>& scans) {
      return explain(*known, job.home, session.options.threads, changes, scans);
    };
  }
  const mapping::MapRun run{.threads = session.options.threads,
                            .seed = session.options.seed,
                            .T_base_camera = job.T_base_camera,
                            .plan = job.extend ? std::nullopt : planFor(job, known),
                            .extended = job.extend ? map : std::filesystem::path(),
                            .explain = explanation,
                            .progress = progress.sink()};
  HomeStage stage(job.home, session.interrupts);
  const mapping::MapResult result = mapping::buildMap(job.recording, job.config, run, stage.mapFolder());
  if (!result.is_placed) {
    return result;
  }
  if (known) {
    writeRoomClouds(*known, stage.mapFolder());
  }
  stage.commit(result.placement ? result.placement->T_map_base : Eigen::Isometry2d::Identity());
  return result;
}

}  // namespace oikos::tools
