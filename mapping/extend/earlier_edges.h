// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

/// The edges of a saved graph between the nodes that are kept, as if the others had been marginalised: the way over a node that is left out
/// becomes one edge whose covariance is the sum along it, and parallel edges become one. A relative pose is that of its nodes, as in the
/// file. What no measurement joins (the wheels alone did) gets a weak edge. All are EdgeKind::kOdometry, from the lower node to the higher.
/// `position`: one a node of `saved`, its number among the kept ones, ascending; -1: left out.
[[nodiscard]] std::vector<Edge> edgesBetweenKept(const KeyframeGraph& saved, const std::vector<int>& position);

}  // namespace oikos::mapping
