// SPDX-License-Identifier: Apache-2.0
// When a joint was moved.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "registration/articulated/joint_fusion.h"

namespace oikos::registration {

/// Where a joint went from and to: rad or m.
struct JointStep {
  double before = 0.0;
  double after = 0.0;
};

/// Log odds of each sighting that the joint is no longer where it was but at the new value, or between both, on its way; 0: it cannot tell.
/// Throws ContractViolation for a step that leads nowhere.
[[nodiscard]] std::vector<double> stepOdds(const std::vector<JointSighting>& sightings, const JointStep& step,
                                           const JointFusionConfig& config);

/// Indices of sightings.
struct JointMoment {
  std::size_t first_after = 0;             ///< the first that shows the joint gone from where it was
  std::optional<std::size_t> last_before;  ///< the last before it that shows it still there: it was moved in between; nothing: none does
};

/// `sightings`: in the order of time, from a time in which the joint stood still before to one after the step. All of them are heard, those
/// too that have not found the joint: what cannot tell where an open door is may well show that it is not shut. Nothing: none of them shows
/// it gone. Time O(n * bins).
[[nodiscard]] std::optional<JointMoment> findMoment(const std::vector<JointSighting>& sightings, const JointStep& step,
                                                    const JointFusionConfig& config);

}  // namespace oikos::registration
