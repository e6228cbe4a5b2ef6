// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

/// Writes the nodes' poses (`VERTEX_SE3:QUAT`, T_map_camera), FIX for the first node of each sub-map, and the believed edges
/// (`EDGE_SE3:QUAT`, information of translation and 2 * sin(angle / 2) * axis, upper triangle), as g2o and its readers expect them
/// (Kümmerle et al., ICRA 2011). The edges of an adjusted graph are made to agree with its poses, so that whoever optimises the
/// file stays at them. Atomic; throws Error{kIo}.
void writeG2o(const KeyframeGraph& graph, const std::vector<char>& believed, const std::filesystem::path& file);

/// The nodes' poses and the edges of such a file; numbering in the file's order of ids. Throws Error with file and line.
[[nodiscard]] KeyframeGraph readG2o(const std::filesystem::path& file);

}  // namespace oikos::mapping
