// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/voxel_ball.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace oikos::mapping {

std::vector<VoxelStep> voxelBall(double radius_m, double resolution_m) {
  const int reach = static_cast<int>(radius_m / resolution_m);
  std::vector<VoxelStep> steps;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double length_m = resolution_m * std::sqrt(x * x + y * y + z * z);
        if (length_m <= radius_m) {
          steps.push_back(
              {packVoxelKey(static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), static_cast<std::uint16_t>(z)), length_m});
        }
      }
    }
  }
  std::sort(steps.begin(), steps.end(),
            [](const VoxelStep& a, const VoxelStep& b) { return std::tie(a.length_m, a.offset) < std::tie(b.length_m, b.offset); });
  return steps;
}

}  // namespace oikos::mapping
