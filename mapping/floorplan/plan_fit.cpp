// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/plan_fit.h"

#include <algorithm>
#include <cmath>

#include "core/base/config_rules.h"
#include "core/base/degrees.h"
#include "core/base/number_text.h"
#include "mapping/floorplan/plan_alignment.h"

namespace oikos::mapping {

namespace {

using base::toFixedText;

constexpr std::size_t kCoarseWalls = 1500;  ///< so many are enough to tell the places apart

std::string percent(double share) {
  return toFixedText(100.0 * share, 0) + " %";
}
std::string metres(double length_m) {
  return toFixedText(length_m, 1) + " m";
}

struct Apart {
  double distance_m;
  double turn_rad;
};

/// How far two placements of the map put its middle from each other, and how far they turn it.
Apart apart(const Eigen::Isometry2d& a, const Eigen::Isometry2d& b, const Eigen::Vector2d& middle_level) {
  return {(a * middle_level - b * middle_level).norm(),
          std::abs(Eigen::Rotation2Dd(Eigen::Matrix2d(a.linear().transpose() * b.linear())).smallestAngle())};
}

class Fitter {
 public:
  Fitter(const WallSketch& sketch, const FloorPlan& plan, const PlanFitConfig& config, const std::optional<Eigen::Isometry2d>& expected)
      : sketch_(sketch), plan_(plan), config_(config), expected_(expected), grid_(plan, kPlanReach_m) {
    for (const WallPoint& wall : sketch.walls) {
      middle_level_ += wall.point_level / static_cast<double>(sketch.walls.size());
    }
  }

  PlanFit fit() {
    if (sketch_.wallLengthM() < config_.min_seen_m) {
      PlanFit none;
      none.figures.seen_m = sketch_.wallLengthM();
      none.reason = "the drive saw " + metres(sketch_.wallLengthM()) + " of walls; at least " + metres(config_.min_seen_m) + " are needed";
      return none;
    }
    alignAll();
    weighAll();
    PlanFit chosen = choose();
    if (!fits_.empty()) {
      checkScale(chosen);
    }
    return chosen;
  }

 private:
  void alignAll() {
    const int every = static_cast<int>(stride());
    std::vector<Eigen::Isometry2d> starts;
    if (expected_) {
      starts.push_back(*expected_);
    }
    for (const PlanCandidate& candidate : searchPlan(sketch_, plan_, config_.search)) {
      starts.push_back(candidate.T_plan_level);
    }
    for (const Eigen::Isometry2d& start : starts) {
      const PlanAlignment coarse = alignToPlan(sketch_, grid_, start, every);
      if (coarse.status == PlanAlignmentStatus::kTooFewPairs || isKnown(coarse.T_plan_level)) {
        continue;
      }
      alignments_.push_back(every == 1 ? coarse : alignToPlan(sketch_, grid_, coarse.T_plan_level, 1));
    }
  }

  [[nodiscard]] bool isKnown(const Eigen::Isometry2d& T_plan_level) const {
    return std::any_of(alignments_.begin(), alignments_.end(),
                       [&](const PlanAlignment& known) { return isSame(known.T_plan_level, T_plan_level, 0.1); });
  }
  [[nodiscard]] bool isSame(const Eigen::Isometry2d& a, const Eigen::Isometry2d& b, double share) const {
    const Apart between = apart(a, b, middle_level_);
    return between.distance_m < share * config_.twin_apart_m && between.turn_rad < share * config_.twin_apart_deg * base::kRadPerDeg;
  }
  [[nodiscard]] bool isExpected(const Eigen::Isometry2d& T_plan_level) const {
    if (!expected_) {
      return false;
    }
    const Apart between = apart(T_plan_level, *expected_, Eigen::Vector2d::Zero());
    return between.distance_m < config_.expected_m && between.turn_rad < config_.expected_deg * base::kRadPerDeg;
  }

  void weighAll() {
    for (const PlanAlignment& alignment : alignments_) {
      PlanFit fit;
      fit.T_plan_level = alignment.T_plan_level;
      fit.figures = weighPlan(sketch_, plan_, grid_, alignment.T_plan_level, {config_.on_line_m, config_.doorway_m});
      fit.moved_room = findMovedRoom(sketch_, plan_, alignment.T_plan_level);
      judge(alignment, fit);
      fits_.push_back(std::move(fit));
    }
    std::stable_sort(fits_.begin(), fits_.end(), [](const PlanFit& a, const PlanFit& b) { return worth(a) > worth(b); });
  }

  /// Length of wall that map and plan agree on, less what they contradict each other in.
  static double worth(const PlanFit& fit) { return fit.figures.on_plan_share * fit.figures.seen_m - fit.figures.crossed_m; }

  /// The reason, if one speaks against it.
  void judge(const PlanAlignment& alignment, PlanFit& fit) const {
    const PlanFigures& f = fit.figures;
    const double max_crossed_m = std::max(config_.max_crossed_m, config_.max_crossed_share * f.supported_m);
    const double max_missing_m = std::max(config_.max_missing_m, config_.max_missing_share * f.supported_m);
    const auto refuse = [&](PlanFitStatus status, const std::string& reason) {
      fit.status = status;
      fit.reason = reason;
    };
    if (alignment.status == PlanAlignmentStatus::kDegenerate) {
      refuse(PlanFitStatus::kOpenDirection, "all walls that lie on the plan run one way: where along them the drive was is not known");
    } else if (f.on_plan_share < config_.min_on_plan_share) {
      refuse(PlanFitStatus::kOffPlan, "only " + percent(f.on_plan_share) +
                                          " of the upright surface seen lie on the plan's walls; at least " +
                                          percent(config_.min_on_plan_share) + " must");
    } else if (f.crossed_m > max_crossed_m) {
      refuse(PlanFitStatus::kCrossed, metres(f.crossed_m) + " of the plan's walls lead over open floor, doorways not counted; at most " +
                                          metres(max_crossed_m) + " may");
    } else if (f.missing_m > max_missing_m) {
      refuse(PlanFitStatus::kMissing,
             metres(f.missing_m) +
                 " of the plan's walls were not seen although nothing stands before them, doorways not counted; at most " +
                 metres(max_missing_m) + " may be missing");
    } else if (fit.moved_room.gain_share > config_.max_moved_share) {
      refuse(PlanFitStatus::kMovedRoom, "a room was seen " + toFixedText(fit.moved_room.shift_plan.norm(), 2) +
                                            " m beside where it is drawn: " + percent(fit.moved_room.gain_share) +
                                            " more of its walls lie on the map's there; at most " + percent(config_.max_moved_share) +
                                            " may");
    } else if (f.floor_outside_m2 > config_.max_floor_outside_m2) {
      refuse(PlanFitStatus::kOutside, toFixedText(f.floor_outside_m2, 1) + " m2 of floor were seen where the plan has no room; at most " +
                                          toFixedText(config_.max_floor_outside_m2, 1) + " m2 may be");
    } else if (f.beyond_share > config_.max_beyond_share) {
      refuse(PlanFitStatus::kOutside, percent(f.beyond_share) +
                                          " of the upright surface seen lie beyond the plan's outermost walls; at most " +
                                          percent(config_.max_beyond_share) + " may");
    } else if (f.rms_m > config_.max_rms_m) {
      refuse(PlanFitStatus::kLoose, "the walls lie " + toFixedText(100.0 * f.rms_m, 1) +
                                        " cm from the plan's lines (root mean square); at most " +
                                        toFixedText(100.0 * config_.max_rms_m, 1) + " cm are allowed");
    } else if (f.supported_share < config_.min_supported_share && !isExpected(fit.T_plan_level)) {
      refuse(PlanFitStatus::kTooLittle, "the drive saw only " + percent(f.supported_share) + " of the plan's " + metres(f.plan_m) +
                                            " of walls; at least " + percent(config_.min_supported_share) + " are needed");
    } else {
      fit.status = PlanFitStatus::kFitted;
    }
  }

  /// A plan of the wrong size fits in one corner. The map is tried at other sizes, from where it lies.
  void checkScale(PlanFit& fit) const {
    double best_share = fit.figures.on_plan_share + config_.scale_gain;
    for (int percent_larger = -20; percent_larger <= 25; ++percent_larger) {
      const double scale = 1.0 + percent_larger / 100.0;
      if (std::abs(percent_larger) < 2) {
        continue;
      }
      WallSketch scaled;
      for (std::size_t i = 0; i < sketch_.walls.size(); i += stride()) {
        const WallPoint& wall = sketch_.walls[i];
        scaled.walls.push_back({middle_level_ + scale * (wall.point_level - middle_level_), wall.normal_level});
      }
      const PlanAlignment alignment = alignToPlan(scaled, grid_, fit.T_plan_level, 1);
      const double share = onPlanShare(scaled, alignment.T_plan_level);
      if (share > best_share) {
        best_share = share;
        fit.better_scale = 1.0 / scale;
      }
    }
    if (fit.better_scale == 1.0) {
      return;
    }
    const std::string hint = "at " + toFixedText(fit.better_scale, 2) + " times the plan's size " + percent(best_share) +
                             " of the upright surface seen would lie on its walls";
    if (fit.status == PlanFitStatus::kFitted || fit.status == PlanFitStatus::kAmbiguous) {
      fit.status = PlanFitStatus::kWrongScale;
      fit.reason = hint + ", and " + percent(fit.figures.on_plan_share) + " do: its scale is wrong";
    } else {
      fit.reason += "; " + hint;
    }
  }

  [[nodiscard]] double onPlanShare(const WallSketch& sketch, const Eigen::Isometry2d& T_plan_level) const {
    const auto on_plan = std::count_if(sketch.walls.begin(), sketch.walls.end(), [&](const WallPoint& wall) {
      return grid_.findNearest(T_plan_level * wall.point_level, T_plan_level.linear() * wall.normal_level, config_.on_line_m).has_value();
    });
    return static_cast<double>(on_plan) / static_cast<double>(sketch.walls.size());
  }

  [[nodiscard]] std::size_t stride() const { return std::max<std::size_t>(1, sketch_.walls.size() / kCoarseWalls); }

  [[nodiscard]] PlanFit choose() const {
    if (fits_.empty()) {
      PlanFit none;
      none.status = PlanFitStatus::kNoAlignment;
      none.figures.seen_m = sketch_.wallLengthM();
      none.reason = "there is no place on the plan where walls of the map lie along its lines";
      return none;
    }
    std::vector<PlanFit> possible;
    std::copy_if(fits_.begin(), fits_.end(), std::back_inserter(possible),
                 [](const PlanFit& fit) { return fit.status == PlanFitStatus::kFitted; });
    if (possible.empty()) {
      return fits_.front();
    }
    const double least = config_.twin_share * worth(possible.front());
    const auto expected = std::find_if(possible.begin(), possible.end(),
                                       [&](const PlanFit& fit) { return isExpected(fit.T_plan_level) && worth(fit) >= least; });
    if (expected != possible.end()) {
      return *expected;
    }
    PlanFit best = possible.front();
    const auto other = std::find_if(possible.begin() + 1, possible.end(),
                                    [&](const PlanFit& fit) { return !isSame(fit.T_plan_level, best.T_plan_level, 1.0); });
    if (other != possible.end()) {
      best.runner_up = worth(*other) / worth(best);
    }
    if (best.runner_up >= config_.twin_share) {
      best.status = PlanFitStatus::kAmbiguous;
      best.reason = "another place on the plan, " + metres(apart(best.T_plan_level, other->T_plan_level, middle_level_).distance_m) +
                    " away, fits " + percent(best.runner_up) + " as well; below " + percent(config_.twin_share) + " it would be clear";
    }
    return best;
  }

  const WallSketch& sketch_;
  const FloorPlan& plan_;
  const PlanFitConfig& config_;
  std::optional<Eigen::Isometry2d> expected_;
  LineGrid grid_;
  Eigen::Vector2d middle_level_ = Eigen::Vector2d::Zero();
  std::vector<PlanAlignment> alignments_;
  std::vector<PlanFit> fits_;
};

}  // namespace

std::vector<std::string> PlanFitConfig::validate() const {
  base::ConfigRules rules;
  rules.atLeast("min_seen_m", min_seen_m, 0.0);
  rules.between("min_on_plan_share", min_on_plan_share, 0.0, 1.0).between("min_supported_share", min_supported_share, 0.0, 1.0);
  rules.atLeast("max_crossed_m", max_crossed_m, 0.0).between("max_crossed_share", max_crossed_share, 0.0, 1.0);
  rules.atLeast("max_missing_m", max_missing_m, 0.0).between("max_missing_share", max_missing_share, 0.0, 1.0);
  rules.between("max_moved_share", max_moved_share, 0.0, 1.0).greater("scale_gain", scale_gain, 0.0);
  rules.atLeast("max_floor_outside_m2", max_floor_outside_m2, 0.0).between("max_beyond_share", max_beyond_share, 0.0, 1.0);
  rules.greater("max_rms_m", max_rms_m, 0.0).between("on_line_m", on_line_m, 0.01, 0.5).atLeast("doorway_m", doorway_m, 0.0);
  rules.between("twin_share", twin_share, 0.0, 1.0)
      .greater("twin_apart_m", twin_apart_m, 0.0)
      .greater("twin_apart_deg", twin_apart_deg, 0.0);
  rules.atLeast("expected_m", expected_m, 0.0).atLeast("expected_deg", expected_deg, 0.0);
  return rules.messages();
}

PlanFit fitToPlan(const WallSketch& sketch, const FloorPlan& plan, const PlanFitConfig& config,
                  const std::optional<Eigen::Isometry2d>& T_plan_level_expected) {
  return Fitter(sketch, plan, config, T_plan_level_expected).fit();
}

}  // namespace oikos::mapping
