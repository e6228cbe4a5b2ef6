// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/joint_changes.h"

#include <algorithm>
#include <cmath>

#include "core/base/degrees.h"

namespace oikos::tracking {

namespace {

/// The configuration in the joint's unit.
struct Limits {
  double believed_sigma;
  double min_change;
  double closed;
};
Limits limitsOf(const semantic::Joint& joint, const ChangeTestConfig& config) {
  if (joint.type == semantic::JointType::kRevolute) {
    return {config.believed_sigma_deg * base::kRadPerDeg, config.min_change_deg * base::kRadPerDeg, config.closed_deg * base::kRadPerDeg};
  }
  return {config.believed_sigma_m, config.min_change_m, config.closed_m};
}

/// Where a joint without a value of its own stands: closed is 0, or the limit that is nearest to it.
double closedValue(const semantic::Joint& joint) {
  return std::clamp(0.0, std::min(joint.lower, joint.upper), std::max(joint.lower, joint.upper));
}

/// What a joint is known to be.
struct Known {
  double value = 0.0;
  double variance = 0.0;
};

JointChangeKind kindOf(double before, double after, double closed, double tolerance) {
  const bool was_closed = std::abs(before - closed) <= tolerance;
  const bool is_closed = std::abs(after - closed) <= tolerance;
  if (was_closed != is_closed) {
    return is_closed ? JointChangeKind::kClosed : JointChangeKind::kOpened;
  }
  return JointChangeKind::kMoved;
}

}  // namespace

std::vector<JointChange> findChanges(const std::vector<JointStay>& stays, const semantic::Joint& joint, const ChangeTestConfig& config) {
  const Limits limits = limitsOf(joint, config);
  const double closed = closedValue(joint);
  Known known{joint.value, limits.believed_sigma * limits.believed_sigma};
  std::optional<std::size_t> stay_before;
  std::vector<JointChange> changes;
  for (std::size_t i = 0; i < stays.size(); ++i) {
    const JointStay& stay = stays[i];
    if (!stay.isFound() || stay.found < config.min_images) {
      continue;
    }
    const double difference = std::abs(stay.span.value - known.value);
    const double sigma = std::sqrt(stay.span.variance + known.variance);
    if (difference <= limits.min_change || difference <= config.significance * sigma) {
      stay_before = i;
      continue;
    }
    JointChange change;
    change.before = known.value;
    change.after = std::clamp(stay.span.value, std::min(joint.lower, joint.upper), std::max(joint.lower, joint.upper));
    if (std::abs(change.after - closed) <= limits.closed) {
      change.after = closed;
    }
    change.kind = kindOf(change.before, change.after, closed, limits.closed);
    change.sigma = std::sqrt(stay.span.variance);
    change.confidence = stay.span.confidence * std::erf(difference / sigma / std::sqrt(2.0));
    change.stay = i;
    change.stay_before = stay_before;
    changes.push_back(change);
    known = {change.after, stay.span.variance};
    stay_before = i;
  }
  return changes;
}

}  // namespace oikos::tracking
