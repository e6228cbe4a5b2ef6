// SPDX-License-Identifier: Apache-2.0
// Which values of a joint are looked at. Included by this folder's sources only.
#pragma once

#include <vector>

#include "core/model/articulated_model.h"
#include "registration/articulated/joint_decision.h"

namespace oikos::registration {

/// From limit to limit, evenly, no farther apart than `stride`, five at least. Where there is no limit: `unlimited` beyond the believed
/// value. All rad or m.
[[nodiscard]] std::vector<double> valuesToLookAt(const model::ModelJoint& joint, double believed, double unlimited, double stride);

/// The local maxima of a profile whose log likelihood is positive and within a share of the best one's, which comes first.
[[nodiscard]] std::vector<double> localMaxima(const JointEvidence& evidence, double share, int most);

}  // namespace oikos::registration
