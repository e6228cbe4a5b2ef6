// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/base_check.h"

#include <algorithm>

namespace oikos::tracking {

bool isRefuted(const FurniturePlace& place, const semantic::LargeObject& believed, const std::vector<PieceReading>& pieces) {
  constexpr double kFollowed_m = 0.12;  // four deviations of where a shiftable piece is believed to stand
  constexpr int kLeast = 2;
  const auto piece = std::find_if(pieces.begin(), pieces.end(), [&](const PieceReading& one) { return one.id == place.id; });
  const double way_m = (place.T_map_object.translation() - believed.T_map_object.position_m).norm();
  return piece != pieces.end() && way_m > kFollowed_m && piece->in_place >= kLeast && piece->in_place > 2 * piece->not_there;
}

}  // namespace oikos::tracking
