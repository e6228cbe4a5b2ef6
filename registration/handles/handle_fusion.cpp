// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/handle_fusion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/base/config_rules.h"
#include "core/base/error.h"

namespace oikos::registration {

namespace {

using geometry::Matrix6d;
using geometry::Vector6d;

constexpr int kRounds = 20;

/// An image's estimate about a common pose.
struct Difference {
  Vector6d xi = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();   ///< this image's own
  Matrix6d information = Matrix6d::Zero();  ///< with what the images differ by beyond what they say
  double weight = 1.0;
};

/// What is this image's alone; at least a tenth of the whole.
Matrix6d ownCovariance(const HandleEstimate& estimate) {
  Matrix6d own = estimate.covariance;
  const Vector6d whole = estimate.covariance.diagonal();
  own.diagonal() = (whole - estimate.shared.diagonal()).cwiseMax(0.1 * whole);
  const Vector6d scale = (own.diagonal().array() / whole.array()).sqrt();  // so that it stays a covariance
  return scale.asDiagonal() * estimate.covariance * scale.asDiagonal();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Vector6d medians(const std::vector<Difference>& differences) {
  Vector6d middle;
  for (int i = 0; i < 6; ++i) {
    std::vector<double> values;
    for (const Difference& difference : differences) {
      values.push_back(difference.xi[i]);
    }
    middle[i] = median(std::move(values));
  }
  return middle;
}

HandleStatus mostOften(const std::vector<HandleEstimate>& estimates) {
  std::map<HandleStatus, int> counts;
  for (const HandleEstimate& estimate : estimates) {
    ++counts[estimate.status];
  }
  return std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
}

struct Fused {
  Vector6d xi = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();  ///< without what is shared
};

/// By how much more the images differ than they say, in each direction, by the median of their absolute deviations.
Vector6d excessOf(const std::vector<Difference>& differences, const Vector6d& middle) {
  Vector6d excess;
  for (int i = 0; i < 6; ++i) {
    std::vector<double> deviations;
    std::vector<double> variances;
    for (const Difference& difference : differences) {
      deviations.push_back(std::abs(difference.xi[i] - middle[i]));
      variances.push_back(difference.covariance(i, i));
    }
    const double sigma = 1.4826 * median(std::move(deviations));
    excess[i] = std::max(0.0, sigma * sigma - median(std::move(variances)));
  }
  return excess;
}

Fused fuseDifferences(std::vector<Difference>& differences, const HandleFusionConfig& config) {
  Fused fused{medians(differences), Matrix6d::Zero()};
  const Vector6d excess = excessOf(differences, fused.xi);
  for (Difference& difference : differences) {
    difference.information = (difference.covariance + Matrix6d(excess.asDiagonal())).ldlt().solve(Matrix6d::Identity());
  }
  for (int round = 0; round < kRounds; ++round) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (Difference& difference : differences) {
      const Vector6d off = difference.xi - fused.xi;
      difference.weight = (config.freedom + 6.0) / (config.freedom + off.dot(difference.information * off));
      H += difference.weight * difference.information;
      g += difference.weight * difference.information * difference.xi;
    }
    fused.xi = H.ldlt().solve(g);
    fused.covariance = H.ldlt().solve(Matrix6d::Identity());
  }
  return fused;
}

}  // namespace

std::vector<std::string> HandleFusionConfig::validate() const {
  return base::ConfigRules()
      .greater("freedom", freedom, 0.0)
      .between("repeated", repeated, 0.0, 1.0)
      .greater("min_gain", min_gain, 0.0)
      .between("min_seen", min_seen, 0.0, 1.0)
      .greater("most_apart_m", most_apart_m, 0.0)
      .greater("place_sigma_m", place_sigma_m, 0.0)
      .greater("max_height_m", max_height_m, 0.0)
      .between("outlier", outlier, 0.0, 1.0)
      .messages();
}

HandleFusion::HandleFusion(const HandleFusionConfig& config) : config_(config) {
  OIKOS_CHECK(config.validate().empty());
}

void HandleFusion::add(const HandleEstimate& estimate) {
  OIKOS_CHECK(estimates_.empty() || estimates_.front().handle == estimate.handle);
  estimates_.push_back(estimate);
}

FusedHandle HandleFusion::result() const {
  FusedHandle result;
  result.images = static_cast<int>(estimates_.size());
  if (estimates_.empty()) {
    return result;
  }
  result.status = mostOften(estimates_);
  result.T_part_handle = estimates_.front().T_part_handle;
  result.covariance = estimates_.front().covariance;
  result.length_m = estimates_.front().length_m;
  std::vector<const HandleEstimate*> seen;
  std::vector<const HandleEstimate*> looked;
  for (const HandleEstimate& estimate : estimates_) {
    if (estimate.isSeen()) {
      seen.push_back(&estimate);
    }
    if (!estimate.evidence.places.empty()) {
      looked.push_back(&estimate);
    }
  }
  result.seen = static_cast<int>(seen.size());
  if (static_cast<double>(seen.size()) < config_.min_seen * static_cast<double>(looked.size())) {
    sumUp(looked, result);
  } else if (!seen.empty()) {
    fuseSeen(seen, result);
  }
  return result;
}

void HandleFusion::sumUp(const std::vector<const HandleEstimate*>& looked, FusedHandle& result) const {
  std::array<std::vector<const GripEvidence*>, 2> halves;
  std::vector<const GripEvidence*> all;
  const Eigen::Isometry3d T_part_common = looked.front()->evidence.T_part_believed;
  Vector6d mean = Vector6d::Zero();
  Vector6d squares = Vector6d::Zero();
  for (std::size_t i = 0; i < looked.size(); ++i) {
    all.push_back(&looked[i]->evidence);
    halves[i % 2].push_back(&looked[i]->evidence);
    const Vector6d xi = geometry::logSe3(T_part_common.inverse() * looked[i]->evidence.T_part_believed);
    mean += xi / static_cast<double>(looked.size());
    squares += xi.cwiseAbs2() / static_cast<double>(looked.size());
  }
  const double share = 1.0 / (1.0 + config_.repeated * (static_cast<double>(looked.size()) - 1.0));
  const auto peakOf = [&](const std::vector<const GripEvidence*>& images) {
    return sumEvidence(images, share, config_.place_sigma_m, config_.max_height_m);
  };
  const std::optional<EvidencePeak> peak = peakOf(all);
  result.T_part_handle = T_part_common * geometry::expSe3(mean);
  result.covariance = looked.front()->covariance;
  result.status = HandleStatus::kNotSeen;
  result.gain = peak->gain;
  result.is_summed = true;
  if (!halves[1].empty()) {
    result.spread_m = 0.5 * (peakOf(halves[0])->place_m - peakOf(halves[1])->place_m).norm();
  }
  if (peak->gain < config_.min_gain || result.spread_m > config_.most_apart_m) {
    return;
  }
  result.status = HandleStatus::kFound;
  result.T_part_handle.translate(Eigen::Vector3d(0.0, peak->place_m.x(), peak->place_m.y()));
  const Vector6d wander = (squares - mean.cwiseAbs2()).cwiseMax(0.0);  // of the registered part
  result.covariance.block<2, 2>(1, 1) = peak->covariance;
  result.covariance.diagonal() += wander / static_cast<double>(looked.size());
}

void HandleFusion::fuseSeen(const std::vector<const HandleEstimate*>& seen, FusedHandle& result) const {
  const Eigen::Isometry3d T_part_common = seen.front()->T_part_handle;
  std::vector<Difference> differences;
  std::vector<double> lengths_m;
  for (const HandleEstimate* estimate : seen) {
    differences.push_back(
        {geometry::logSe3(T_part_common.inverse() * estimate->T_part_handle), ownCovariance(*estimate), Matrix6d::Zero(), 1.0});
    lengths_m.push_back(estimate->length_m);
  }
  const Fused fused = fuseDifferences(differences, config_);
  result.T_part_handle = T_part_common * geometry::expSe3(fused.xi);
  result.length_m = median(lengths_m);

  Vector6d shared = Vector6d::Zero();
  double squares_m = 0.0;
  double squares_rad = 0.0;
  double weights = 0.0;
  bool is_found = false;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vector6d off = differences[i].xi - fused.xi;
    shared += differences[i].weight * seen[i]->shared.diagonal();
    weights += differences[i].weight;
    is_found |= seen[i]->status == HandleStatus::kFound;
    if (differences[i].weight < config_.outlier) {
      ++result.outliers;
      continue;
    }
    squares_m += off.head<3>().squaredNorm();
    squares_rad += off.tail<3>().squaredNorm();
  }
  const double agreed = std::max(1, result.seen - result.outliers);
  result.spread_m = std::sqrt(squares_m / agreed);
  result.spread_deg = std::sqrt(squares_rad / agreed) * 180.0 / std::numbers::pi;
  result.status = is_found ? HandleStatus::kFound : HandleStatus::kPartly;
  const double images = static_cast<double>(seen.size());
  const double repeating = 1.0 + config_.repeated * (images - 1.0);  // images that repeat each other count for fewer
  result.covariance = repeating * fused.covariance;
  result.covariance.diagonal() += shared / weights;
}

}  // namespace oikos::registration
