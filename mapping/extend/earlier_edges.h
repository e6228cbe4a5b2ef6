// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

/// The edges of a saved graph between the nodes that are kept, as if the others had been marginalised: the way over a node that is left out
/// becomes one edge whose covariance is the sum along it, and parallel edges become one. A relative pose is that of its nodes, as in the
/// file. Nodes that follow each other in a drive get a weak edge in any case, and so does what would fall apart without one: what the
/// wheels alone had joined keeps its place until something else is seen. All are EdgeKind::kOdometry, from the lower node to the higher.
/// `position`: one a node of `saved`, its number among the kept ones, ascending; -1: left out. `drive`: of each kept one.
[[nodiscard]] std::vector<Edge> edgesBetweenKept(const KeyframeGraph& saved, const std::vector<int>& position,
                                                 const std::vector<int>& drive);

}  // namespace oikos::mapping
