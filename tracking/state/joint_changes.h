// SPDX-License-Identifier: Apache-2.0
// From readings of a joint to what happened to it: a hypothesis test for each stay, so that noise is no event.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "semantic/model/home.h"
#include "tracking/state/state_config.h"
#include "tracking/state/state_reader.h"

namespace oikos::tracking {

enum class JointChangeKind { kOpened, kClosed, kMoved };
constexpr auto enumTable(JointChangeKind) {
  return std::to_array<base::EnumName<JointChangeKind>>(
      {{JointChangeKind::kOpened, "opened"}, {JointChangeKind::kClosed, "closed"}, {JointChangeKind::kMoved, "moved"}});
}

/// A joint that stands elsewhere than was believed.
struct JointChange {
  JointChangeKind kind = JointChangeKind::kMoved;
  double before = 0.0;                     ///< rad or m
  double after = 0.0;                      ///< within the joint's limits
  double sigma = 0.0;                      ///< of `after`
  double confidence = 0.0;                 ///< that it stands there, and not where it stood before
  std::size_t stay = 0;                    ///< index of the stay that it ended in,
  std::optional<std::size_t> stay_before;  ///< and of the last one where it stood before; nothing: that was before the recording
};

/// Each stay of the joint is tested against the one before it, the first against what is believed: `joint.value`, to within
/// the configuration's deviations. H0: nothing has moved. Stays that did not find the joint, or too few of whose images did, say nothing.
/// In the order of time.
[[nodiscard]] std::vector<JointChange> findChanges(const std::vector<JointStay>& stays, const semantic::Joint& joint,
                                                   const ChangeTestConfig& config);

}  // namespace oikos::tracking
