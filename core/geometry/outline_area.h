// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace oikos::geometry {

/// Twice the area that a closed outline encloses (m^2), positive if its corners go round to the left.
[[nodiscard]] inline double signedDoubleArea(const std::vector<Eigen::Vector2d>& outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  return area;
}

}  // namespace oikos::geometry
