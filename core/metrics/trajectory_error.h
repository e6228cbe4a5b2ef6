// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/geometry/rigid_alignment.h"
#include "core/metrics/error_statistics.h"
#include "core/metrics/trajectory_association.h"
#include "core/recording/trajectory.h"

namespace oikos::metrics {

/// Which later pose closes a pair one second long.
enum class SecondPairs {
  kAtOrAfter,  ///< the first not earlier than the interval's end
  kNearest,    ///< the nearest to it, as TUM's evaluate_rpe.py
};
constexpr auto enumTable(SecondPairs) {
  return std::to_array<base::EnumName<SecondPairs>>({{SecondPairs::kAtOrAfter, "at-or-after"}, {SecondPairs::kNearest, "nearest"}});
}

/// Along whose path a pair one metre long is measured.
enum class MetrePairs {
  kAlongEstimate,  ///< as TUM's evaluate_rpe.py and evo; a jittering estimate gets shorter pairs
  kAlongTruth,     ///< the same pairs for every estimate, as evo's --pairs_from_reference
};
constexpr auto enumTable(MetrePairs) {
  return std::to_array<base::EnumName<MetrePairs>>({{MetrePairs::kAlongEstimate, "estimate"}, {MetrePairs::kAlongTruth, "truth"}});
}

struct TrajectoryErrorConfig {
  Association association = Association::kInterpolated;
  geometry::AlignmentScale scale = geometry::AlignmentScale::kFixed;
  SecondPairs second_pairs = SecondPairs::kAtOrAfter;
  MetrePairs metre_pairs = MetrePairs::kAlongEstimate;
  double max_association_s = 0.02;    ///< an estimate farther from every true stamp has no pair
  double interval_s = 1.0;            ///< of the relative error by time
  double interval_slack_s = 0.03;     ///< pairs whose time differs more from `interval_s` are left out
  double distance_m = 1.0;            ///< of the relative error by path
  double distance_slack_ratio = 0.1;  ///< pairs whose path differs more, as a share of `distance_m`, are left out; evo's tenth

  /// What is wrong, a line each; empty when all is well.
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class TrajectoryErrorStatus {
  kEmptyInput,    ///< a trajectory has no pose
  kNoOverlap,     ///< no estimated stamp is near a true one
  kTooFewPairs,   ///< fewer than three pairs: nothing to align
  kUndetermined,  ///< positions lie on a line: the figures hold, the aligning rotation about the line is arbitrary
  kEvaluated,
};
constexpr auto enumTable(TrajectoryErrorStatus) {
  return std::to_array<base::EnumName<TrajectoryErrorStatus>>({{TrajectoryErrorStatus::kEmptyInput, "empty-input"},
                                                               {TrajectoryErrorStatus::kNoOverlap, "no-overlap"},
                                                               {TrajectoryErrorStatus::kTooFewPairs, "too-few-pairs"},
                                                               {TrajectoryErrorStatus::kUndetermined, "undetermined"},
                                                               {TrajectoryErrorStatus::kEvaluated, "evaluated"}});
}

/// Of the motion over pairs of times: E = (T_truth_i^-1 T_truth_j)^-1 (T_estimate_i^-1 T_estimate_j). Needs no alignment.
struct RelativeError {
  ErrorStatistics translation_m;  ///< length of E's translation; `count` is 0 when no pair is long enough
  ErrorStatistics rotation_rad;   ///< E's angle
};

struct [[nodiscard]] TrajectoryError {
  TrajectoryErrorStatus status = TrajectoryErrorStatus::kEmptyInput;
  int estimate_count = 0;
  int truth_count = 0;
  int association_count = 0;
  double duration_s = 0.0;             ///< from the first to the last pair
  double truth_path_m = 0.0;           ///< along the pairs' true positions
  geometry::RigidAlignment alignment;  ///< T_truth_estimate
  ErrorStatistics absolute_m;          ///< ATE: distance of each aligned position to the true one
  double motionless_absolute_m = 0.0;  ///< the ATE RMSE of a camera that never moves: an ATE near it says nothing
  RelativeError per_interval;          ///< RPE over `interval_s`
  RelativeError per_distance;          ///< RPE over `distance_m`
};

/// Errors of a trajectory as the field defines them: Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS
/// 2012 (doi:10.1109/IROS.2012.6385773); the rules for pairs are those of TUM's scripts and of evo where the configuration says
/// so. O(n log n).
TrajectoryError evaluateTrajectory(const recording::Trajectory& estimate, const recording::Trajectory& truth,
                                   const TrajectoryErrorConfig& config = {});

}  // namespace oikos::metrics
