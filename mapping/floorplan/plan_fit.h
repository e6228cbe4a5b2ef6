// SPDX-License-Identifier: Apache-2.0
// Which place on a plan is the map's, if any (S57-S58).
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "mapping/floorplan/moved_room.h"
#include "mapping/floorplan/plan_evidence.h"
#include "mapping/floorplan/plan_search.h"

namespace oikos::mapping {

struct PlanFitConfig {
  PlanSearchConfig search;
  double min_seen_m = 6.0;            ///< of walls; a map with less cannot tell one plan from another
  double min_on_plan_share = 0.5;     ///< of the upright surface seen; the rest may be furniture
  double min_supported_share = 0.4;   ///< of the plan's walls; not asked of a fit where the drive was expected to begin
  double max_crossed_m = 0.6;         ///< of drawn walls where there is floor, beyond a doorway's width each
  double max_crossed_share = 0.02;    ///< of the plan's walls that were seen; the greater of both limits counts
  double max_missing_m = 1.5;         ///< of drawn walls that nothing hides, but that were not seen, beyond a doorway's width each
  double max_missing_share = 0.03;    ///< of the plan's walls that were seen; the greater of both limits counts
  double max_floor_outside_m2 = 0.5;  ///< of floor where the plan has no room
  double max_beyond_share = 0.08;     ///< of the upright surface seen: beyond the plan's outermost walls
  double max_rms_m = 0.04;            ///< of walls from their lines
  double max_moved_share = 0.12;      ///< of a room's walls: so much more seen beside their place, and the room is drawn wrongly
  double scale_gain = 0.08;           ///< so much more of the upright surface on a plan of another size, and the size is wrong
  double on_line_m = 0.08;            ///< a surface that is nearer to a line is on it
  double doorway_m = 1.2;             ///< widest opening that the plan need not show
  double twin_share = 0.85;           ///< another place with so much of the best one's support is as good
  double twin_apart_m = 0.4;          ///< places nearer than this, and turned less than the next, are one
  double twin_apart_deg = 5.0;
  double expected_m = 1.0;  ///< of twins the one is right that has the drive begin so near to where it is expected to
  double expected_deg = 30.0;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("search", search);
    visitor("min_seen_m", min_seen_m);
    visitor("min_on_plan_share", min_on_plan_share);
    visitor("min_supported_share", min_supported_share);
    visitor("max_crossed_m", max_crossed_m);
    visitor("max_crossed_share", max_crossed_share);
    visitor("max_missing_m", max_missing_m);
    visitor("max_missing_share", max_missing_share);
    visitor("max_floor_outside_m2", max_floor_outside_m2);
    visitor("max_beyond_share", max_beyond_share);
    visitor("max_rms_m", max_rms_m);
    visitor("max_moved_share", max_moved_share);
    visitor("scale_gain", scale_gain);
    visitor("on_line_m", on_line_m);
    visitor("doorway_m", doorway_m);
    visitor("twin_share", twin_share);
    visitor("twin_apart_m", twin_apart_m);
    visitor("twin_apart_deg", twin_apart_deg);
    visitor("expected_m", expected_m);
    visitor("expected_deg", expected_deg);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class PlanFitStatus {
  kTooFewWalls,    ///< the map has too few
  kNoAlignment,    ///< no place on the plan has walls near lines
  kOpenDirection,  ///< the walls on lines run one way only: where along them is not known
  kOffPlan,        ///< what was seen is not drawn
  kCrossed,        ///< what is drawn leads over floor
  kMissing,        ///< what is drawn and nothing hides was not seen
  kMovedRoom,      ///< a room was seen beside where it is drawn
  kWrongScale,     ///< the plan fits better at another size
  kOutside,        ///< floor or walls were seen where the plan has no room
  kLoose,          ///< the walls lie too far from their lines
  kTooLittle,      ///< too little of the plan was seen
  kAmbiguous,      ///< several places are as good
  kFitted,
};
constexpr auto enumTable(PlanFitStatus) {
  return std::to_array<base::EnumName<PlanFitStatus>>({{PlanFitStatus::kTooFewWalls, "too-few-walls"},
                                                       {PlanFitStatus::kNoAlignment, "no-alignment"},
                                                       {PlanFitStatus::kOpenDirection, "open-direction"},
                                                       {PlanFitStatus::kOffPlan, "off-plan"},
                                                       {PlanFitStatus::kCrossed, "crossed"},
                                                       {PlanFitStatus::kMissing, "missing"},
                                                       {PlanFitStatus::kMovedRoom, "moved-room"},
                                                       {PlanFitStatus::kWrongScale, "wrong-scale"},
                                                       {PlanFitStatus::kOutside, "outside"},
                                                       {PlanFitStatus::kLoose, "loose"},
                                                       {PlanFitStatus::kTooLittle, "too-little"},
                                                       {PlanFitStatus::kAmbiguous, "ambiguous"},
                                                       {PlanFitStatus::kFitted, "fitted"}});
}

struct [[nodiscard]] PlanFit {
  PlanFitStatus status = PlanFitStatus::kTooFewWalls;
  std::string reason;                                              ///< for a person: the figure that decides, and its limit; empty: fitted
  Eigen::Isometry2d T_plan_level = Eigen::Isometry2d::Identity();  ///< of the best place, fitted or not
  MovedRoom moved_room;       ///< the room of the plan that the map shows beside its place most clearly, if any
  PlanFigures figures;        ///< there
  double better_scale = 1.0;  ///< so many times its size the plan would fit clearly better; 1: it would not
  double runner_up = 0.0;     ///< support of the best other place that nothing speaks against / the best one's; 0: there is none
};

/// `T_plan_level_expected`: where the map would lie if the drive began where it is said to; decides between twins and is a start of its
/// own, nothing more. Searches the whole plan, aligns the best places and weighs each.
PlanFit fitToPlan(const WallSketch& sketch, const FloorPlan& plan, const PlanFitConfig& config,
                  const std::optional<Eigen::Isometry2d>& T_plan_level_expected = std::nullopt);

}  // namespace oikos::mapping
