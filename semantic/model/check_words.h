// SPDX-License-Identifier: Apache-2.0
// What the checks of a home say alike. Included by this folder's sources only.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace oikos::semantic {

[[nodiscard]] inline std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

/// Of length 1, as far as a file writes it.
[[nodiscard]] inline bool isDirection(const Eigen::Vector3d& axis) {
  return std::abs(axis.norm() - 1.0) < 1e-3;
}

}  // namespace oikos::semantic
