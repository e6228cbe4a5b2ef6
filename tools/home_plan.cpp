// SPDX-License-Identifier: Apache-2.0
#include "tools/home_plan.h"

namespace oikos::tools {

mapping::FloorPlan planOf(const semantic::Home& home) {
  mapping::FloorPlan plan;
  for (const semantic::Room& room : home.rooms) {
    if (room.outline_map.size() >= 3) {
      addRoom(room.outline_map, plan);
    }
  }
  return plan;
}

}  // namespace oikos::tools
