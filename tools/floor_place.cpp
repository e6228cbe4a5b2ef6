// SPDX-License-Identifier: Apache-2.0
#include "tools/floor_place.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/number_text.h"

namespace oikos::tools {

Eigen::Isometry3d FloorPlace::T_map_base() const {
  return Eigen::Translation3d(position_map.x(), position_map.y(), 0.0) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
}

FloorPlace parseFloorPlace(const std::string& text, const std::string& option) {
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto number = base::findNumber(part);
    if (number && std::isfinite(*number)) {
      numbers.push_back(*number);
    }
  }
  if (numbers.size() != 3 || std::count(text.begin(), text.end(), ',') != 2) {
    throw base::Error(base::ErrorCode::kUsage, "'" + text + "' is no place such as 1.5,-2,90 (m, m, degrees)", option);
  }
  return {{numbers[0], numbers[1]}, numbers[2] * base::kRadPerDeg};
}

}  // namespace oikos::tools
