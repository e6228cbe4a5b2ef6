// SPDX-License-Identifier: Apache-2.0
// J. Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012: absolute trajectory error after alignment
// in closed form, and relative pose error.
#include "core/metrics/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/number_text.h"

namespace oikos::metrics {

namespace {

/// Stamps in files are rounded, most often to a microsecond.
constexpr std::int64_t kStampRounding_ns = 1'000;

using Pairs = std::vector<PosePair>;
using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

std::vector<Eigen::Vector3d> positionsOf(const Pairs& pairs, Eigen::Isometry3d PosePair::*T_world_camera) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(pairs.size());
  for (const PosePair& pair : pairs) {
    positions.push_back((pair.*T_world_camera).translation());
  }
  return positions;
}

std::vector<double> distancesAlong(const std::vector<Eigen::Vector3d>& positions) {
  std::vector<double> distances_m(positions.size(), 0.0);
  for (std::size_t i = 1; i < positions.size(); ++i) {
    distances_m[i] = distances_m[i - 1] + (positions[i] - positions[i - 1]).norm();
  }
  return distances_m;
}

ErrorStatistics absoluteError(const std::vector<Eigen::Vector3d>& truth, const std::vector<Eigen::Vector3d>& estimate,
                              const geometry::RigidAlignment& alignment) {
  std::vector<double> errors_m;
  errors_m.reserve(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    errors_m.push_back((truth[i] - alignment.apply(estimate[i])).norm());
  }
  return statisticsOf(std::move(errors_m));
}

/// The best that a motionless estimate can be aligned to is the truth's centre.
double motionlessError(const std::vector<Eigen::Vector3d>& truth) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& position : truth) {
    centre += position / static_cast<double>(truth.size());
  }
  double sum_sq = 0.0;
  for (const Eigen::Vector3d& position : truth) {
    sum_sq += (position - centre).squaredNorm();
  }
  return std::sqrt(sum_sq / static_cast<double>(truth.size()));
}

IndexPairs pairsByTime(const Pairs& pairs, const TrajectoryErrorConfig& config) {
  const std::int64_t interval_ns = nanoseconds(config.interval_s);
  const std::int64_t slack_ns = nanoseconds(config.interval_slack_s);
  const auto earlier = [](const PosePair& pair, std::int64_t stamp_ns) { return pair.stamp_ns < stamp_ns; };
  IndexPairs indices;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::int64_t end_ns = pairs[i].stamp_ns + interval_ns;
    const auto from = pairs.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    auto found = std::lower_bound(from, pairs.end(), end_ns - kStampRounding_ns, earlier);
    const bool nearest = config.second_pairs == SecondPairs::kNearest;
    if (nearest && found != from && (found == pairs.end() || end_ns - std::prev(found)->stamp_ns <= found->stamp_ns - end_ns)) {
      --found;
    }
    if (found != pairs.end() && std::abs(found->stamp_ns - end_ns) < slack_ns) {
      indices.emplace_back(i, static_cast<std::size_t>(found - pairs.begin()));
    }
  }
  return indices;
}

/// Index > `start` whose distance is nearest to `target_m`; of equal ones the first.
std::optional<std::size_t> findNearestDistance(const std::vector<double>& distances_m, std::size_t start, double target_m) {
  const auto from = distances_m.begin() + static_cast<std::ptrdiff_t>(start) + 1;
  if (from == distances_m.end()) {
    return std::nullopt;
  }
  auto found = std::lower_bound(from, distances_m.end(), target_m);
  if (found != from && (found == distances_m.end() || target_m - *std::prev(found) <= *found - target_m)) {
    found = std::lower_bound(from, distances_m.end(), *std::prev(found));
  }
  return static_cast<std::size_t>(found - distances_m.begin());
}

IndexPairs pairsByPath(const std::vector<double>& distances_m, const TrajectoryErrorConfig& config) {
  IndexPairs indices;
  for (std::size_t i = 0; i < distances_m.size(); ++i) {
    const double target_m = distances_m[i] + config.distance_m;
    const auto j = findNearestDistance(distances_m, i, target_m);
    if (j && std::abs(distances_m[*j] - target_m) <= config.distance_slack_ratio * config.distance_m) {
      indices.emplace_back(i, *j);
    }
  }
  return indices;
}

/// |log(R)| without the loss of digits that the arc cosine of the trace has near zero.
double angleOf(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

RelativeError relativeError(const Pairs& pairs, const IndexPairs& indices, double scale) {
  std::vector<double> translations_m;
  std::vector<double> rotations_rad;
  for (const auto& [i, j] : indices) {
    const Eigen::Isometry3d T_i_j_truth = pairs[i].T_truth_camera.inverse() * pairs[j].T_truth_camera;
    Eigen::Isometry3d T_i_j_estimate = pairs[i].T_estimate_camera.inverse() * pairs[j].T_estimate_camera;
    T_i_j_estimate.translation() *= scale;
    const Eigen::Isometry3d E = T_i_j_truth.inverse() * T_i_j_estimate;
    translations_m.push_back(E.translation().norm());
    rotations_rad.push_back(angleOf(E.linear()));
  }
  return {statisticsOf(std::move(translations_m)), statisticsOf(std::move(rotations_rad))};
}

TrajectoryErrorStatus statusOf(const TrajectoryError& result) {
  if (result.estimate_count == 0 || result.truth_count == 0) {
    return TrajectoryErrorStatus::kEmptyInput;
  }
  if (result.association_count == 0) {
    return TrajectoryErrorStatus::kNoOverlap;
  }
  if (result.association_count < 3) {
    return TrajectoryErrorStatus::kTooFewPairs;
  }
  return result.alignment.status == geometry::RigidAlignmentStatus::kCollinear ? TrajectoryErrorStatus::kUndetermined
                                                                               : TrajectoryErrorStatus::kEvaluated;
}

void evaluateRelative(const Pairs& pairs, const std::vector<double>& truth_distances_m, std::vector<double> estimate_distances_m,
                      const TrajectoryErrorConfig& config, TrajectoryError& result) {
  const double scale = result.alignment.scale;
  for (double& distance_m : estimate_distances_m) {
    distance_m *= scale;
  }
  const bool along_truth = config.metre_pairs == MetrePairs::kAlongTruth;
  result.per_interval = relativeError(pairs, pairsByTime(pairs, config), scale);
  result.per_distance = relativeError(pairs, pairsByPath(along_truth ? truth_distances_m : estimate_distances_m, config), scale);
}

}  // namespace

std::vector<std::string> TrajectoryErrorConfig::validate() const {
  std::vector<std::string> problems;
  const auto requirePositive = [&problems](const char* name, double value) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      problems.push_back(std::string("trajectory_error.") + name + " = " + base::toText(value) + ": must be > 0");
    }
  };
  requirePositive("max_association_s", max_association_s);
  requirePositive("interval_s", interval_s);
  requirePositive("interval_slack_s", interval_slack_s);
  requirePositive("distance_m", distance_m);
  requirePositive("distance_slack_ratio", distance_slack_ratio);
  return problems;
}

TrajectoryError evaluateTrajectory(const recording::Trajectory& estimate, const recording::Trajectory& truth,
                                   const TrajectoryErrorConfig& config) {
  OIKOS_CHECK(config.validate().empty());
  const Pairs pairs = associate(estimate, truth, config.association, nanoseconds(config.max_association_s));
  TrajectoryError result;
  result.estimate_count = static_cast<int>(estimate.size());
  result.truth_count = static_cast<int>(truth.size());
  result.association_count = static_cast<int>(pairs.size());
  if (pairs.size() >= 3) {
    const std::vector<Eigen::Vector3d> truth_positions = positionsOf(pairs, &PosePair::T_truth_camera);
    const std::vector<Eigen::Vector3d> estimate_positions = positionsOf(pairs, &PosePair::T_estimate_camera);
    const std::vector<double> truth_distances_m = distancesAlong(truth_positions);
    result.duration_s = static_cast<double>(pairs.back().stamp_ns - pairs.front().stamp_ns) * 1e-9;
    result.truth_path_m = truth_distances_m.back();
    result.alignment = geometry::alignRigid(truth_positions, estimate_positions, {}, config.scale);
    result.absolute_m = absoluteError(truth_positions, estimate_positions, result.alignment);
    result.motionless_absolute_m = motionlessError(truth_positions);
    evaluateRelative(pairs, truth_distances_m, distancesAlong(estimate_positions), config, result);
  }
  result.status = statusOf(result);
  return result;
}

}  // namespace oikos::metrics
