// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace oikos::semantic {

/// Whether the point is within the polygon, whichever way round its corners go; the edge belongs to neither side for certain.
[[nodiscard]] bool isInside(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& polygon);

/// From its edge, inside or outside (m).
[[nodiscard]] double distanceToEdge(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& outline);

}  // namespace oikos::semantic
