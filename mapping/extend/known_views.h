// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mapping/extend/revision_config.h"
#include "mapping/volume/map_builder.h"

namespace oikos::mapping {

/// Which of the drive's views show next to nothing that earlier keyframes do not show as well, from like directions: they bring no new
/// place (S44), and a map that keeps them grows with every drive. A point of a view is known if an earlier keyframe has a reading within
/// 5 cm and 5 % of it. One entry a view of `fresh`; a view without readings shows nothing new. The same for any number of threads.
[[nodiscard]] std::vector<char> findKnownViews(const std::vector<View>& earlier, const std::vector<View>& fresh, const FusionInput& input,
                                               const RevisionConfig& config);

}  // namespace oikos::mapping
