// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/conclusion.h"

#include <algorithm>
#include <cstddef>

namespace oikos::registration {

namespace {

/// One result in the making.
class ResultMaker {
 public:
  ResultMaker(const JointTree& tree, const ArticulatedConfig& config, const JointFindings& findings, const SolverReport& report)
      : tree_(tree), config_(config), findings_(findings), report_(report) {}

  [[nodiscard]] ArticulatedResult make() const {
    ArticulatedResult result;
    const Standing& standing = findings_.estimates.standing;
    result.T_map_model = standing.T_map_model;
    result.covariance = report_.base_covariance;
    result.base_counts = report_.counts.empty() ? LinkCounts() : report_.counts[0];
    result.rms_m = report_.rms_m;
    result.status = statusOf(result.base_counts);
    for (std::size_t link = 1; link < tree_.links().size(); ++link) {
      result.joints.push_back(estimateOf(link));
      if (hangsInTheAir(result.status, link) && result.joints.back().status == JointStatus::kFound) {
        result.joints.back().status = JointStatus::kNotObservable;
      }
    }
    result.joint_values = standing.joint_values;
    for (const Eigen::Isometry3d& T_model_part : tree_.partPoses(standing.joint_values)) {
      result.T_map_part.push_back(standing.T_map_model * T_model_part);
    }
    for (JointEstimate& estimate : result.joints) {
      const model::ModelJoint& joint = tree_.model().joints[static_cast<std::size_t>(estimate.joint)];
      estimate.T_map_part = result.T_map_part[static_cast<std::size_t>(joint.child)];
      estimate.T_parent_part = result.T_map_part[static_cast<std::size_t>(joint.parent)].inverse() * estimate.T_map_part;
    }
    return result;
  }

 private:
  [[nodiscard]] BaseStatus statusOf(const LinkCounts& counts) const {
    const int speaking = counts.agreeing + counts.behind;
    if (speaking < config_.min_base_pixels) {
      return BaseStatus::kNotInView;
    }
    return counts.agreeing >= config_.min_base_share * speaking ? BaseStatus::kRegistered : BaseStatus::kNotThere;
  }

  /// The readings do not fit the base; or nobody has seen it, and to explain them, it was carried farther than it is likely to be off: it
  /// is a wall that looks like an open door.
  [[nodiscard]] bool hangsInTheAir(BaseStatus base, std::size_t link) const {
    const double max_off_sq = config_.max_unseen_off * config_.max_unseen_off;
    return base == BaseStatus::kNotThere ||
           (base == BaseStatus::kNotInView && !report_.off_prior.empty() && report_.off_prior[link] > max_off_sq);
  }

  [[nodiscard]] JointEstimate estimateOf(std::size_t link) const {
    JointEstimate estimate;
    estimate.joint = tree_.links()[link].joint;
    estimate.name = tree_.jointOf(static_cast<int>(link)).name;
    estimate.value = findings_.estimates.standing.joint_values[static_cast<std::size_t>(estimate.joint)];
    estimate.evidence = findings_.evidence[link];
    estimate.sight = findings_.sights[link];
    if (!report_.counts.empty()) {
      const LinkCounts& counts = report_.counts[link];
      estimate.sight.read = counts.read;
      estimate.sight.agreeing = counts.agreeing;
      estimate.sight.nearer = counts.nearer;
      estimate.sight.behind = counts.behind;
      estimate.evidence.variance = report_.variances[link];
      estimate.evidence.shared_variance = report_.shared_variances[link];
    }
    const JointDecision decision = decide(estimate.evidence, estimate.sight, config_.decision);
    estimate.status = decision.status;
    estimate.confidence = decision.confidence;
    estimate.variance = varianceOf(estimate);
    return estimate;
  }

  /// Of the value: as solved for, or of the values that may be as well; of a joint that is never seen, of all in its range.
  [[nodiscard]] static double varianceOf(const JointEstimate& estimate) {
    const JointEvidence& evidence = estimate.evidence;
    if (estimate.status == JointStatus::kFound) {
      return evidence.variance;
    }
    if (estimate.sight.is_ever_seen) {
      return momentsOf(evidence).variance + evidence.variance;
    }
    const double range = evidence.values.back() - evidence.values.front();
    return range * range / 12.0;
  }

  const JointTree& tree_;
  const ArticulatedConfig& config_;
  const JointFindings& findings_;
  const SolverReport& report_;
};

}  // namespace

ArticulatedResult resultOf(const JointTree& tree, const ArticulatedConfig& config, const JointFindings& findings,
                           const SolverReport& report) {
  return ResultMaker(tree, config, findings, report).make();
}

}  // namespace oikos::registration
