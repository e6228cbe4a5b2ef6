// SPDX-License-Identifier: Apache-2.0
// One image's word on a joint, as a density over its range. Included by this folder's sources only.
#pragma once

#include <cstddef>
#include <vector>

#include "registration/articulated/joint_fusion.h"

namespace oikos::registration {

/// The joint's range, cut finely: rad or m.
struct JointBins {
  double first = 0.0;
  double width = 0.0;
  std::size_t count = 0;
  [[nodiscard]] double at(std::size_t i) const { return first + width * static_cast<double>(i); }
};
[[nodiscard]] JointBins binsOf(const JointEvidence& evidence, const JointFusionConfig& config);

/// Whether the image sees the joint at all.
[[nodiscard]] bool seesJoint(const JointSighting& sighting);

/// Log of the chance of each bin, as one image that sees the joint has it; misreadings may be anywhere.
[[nodiscard]] std::vector<double> logChances(const JointBins& bins, const JointSighting& sighting, const JointFusionConfig& config);

}  // namespace oikos::registration
