// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/outline.h"

#include <algorithm>
#include <limits>

#include <cstddef>

namespace oikos::semantic {

bool isInside(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& polygon) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) && point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      inside = !inside;
    }
  }
  return inside;
}

double distanceToEdge(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& outline) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d side = outline[(i + 1) % outline.size()] - outline[i];
    const double length_sq = side.squaredNorm();
    const double along = length_sq > 0.0 ? std::clamp((point - outline[i]).dot(side) / length_sq, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (outline[i] + along * side - point).norm());
  }
  return nearest;
}

}  // namespace oikos::semantic
