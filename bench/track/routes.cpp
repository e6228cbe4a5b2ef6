// SPDX-License-Identifier: Apache-2.0
#include "bench/track/routes.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"

namespace oikos::bench {

std::vector<Route> routesWithin(const std::map<std::string, double>& free_uppers) {
  std::vector<Route> all = {
      {"kitchen",
       {1.1, 1.6, 75.0},
       {"1.0 2.3 look -45", "1.4 2.3 yaw 178"},
       {{"fridge-door-joint", 110.0, true, 4.0},
        {"fridge-freezer_door-joint", 110.0, true, 4.0},
        {"cupboard-door-joint", 110.0, true, 4.0},
        {"drawers-drawer_0-joint", 0.43, false, 3.5},
        {"drawers-drawer_1-joint", 0.43, false, 3.5},
        {"oven-door-joint", 90.0, true, 3.5},
        {"dishwasher-door-joint", 90.0, true, 3.5}}},
      {"living room",
       {2.1, -1.9, -90.0},
       {"2.2 -2.7 look 40", "1.9 -2.6 yaw -165"},
       {{"chest-drawer_0-joint", 0.33, false, 3.5},
        {"chest-drawer_1-joint", 0.33, false, 3.5},
        {"chest-drawer_2-joint", 0.33, false, 3.5},
        {"sideboard-left_door-joint", 110.0, true},
        {"sideboard-right_door-joint", 110.0, true}}},
      {"bedroom",
       {7.0, 0.1, 0.0},
       {"7.6 -0.2 look 50", "7.4 -0.4 yaw -100"},
       {{"wardrobe-left_door-joint", 110.0, true, 3.0},
        {"wardrobe-right_door-joint", 110.0, true, 3.0},
        {"linen-chest-drawer_0-joint", 0.33, false},
        {"linen-chest-drawer_1-joint", 0.33, false}}},
      {"hall and bathroom",
       {2.0, -0.2, 35.0},
       {"3.9 0.1", "4.7 0.4", "4.7 1.4 look -60"},
       {{"shoe-cabinet-left_door-joint", 110.0, true, 1.5},
        {"shoe-cabinet-right_door-joint", 110.0, true, 1.5},
        {"washstand-left_door-joint", 110.0, true, 7.0},
        {"washstand-right_door-joint", 110.0, true, 7.0}}},
      {"tall cupboard",  // its open doors fill the picture, and the map has hardly seen it
       {1.4, 1.6, 110.0},
       {"1.2 2.0 yaw 170", "1.2 2.0 yaw 178"},
       {{"crockery-left_door-joint", 110.0, true, 6.0},
        {"crockery-right_door-joint", 110.0, true, 6.0},
        {"cupboard-door-joint", 110.0, true}}},
  };
  for (Route& route : all) {
    for (RouteJoint& joint : route.joints) {
      joint.upper = std::min(joint.upper, free_uppers.at(joint.id));
    }
  }
  return all;
}

std::string changeText(const std::string& id, const Stand& stand) {
  return id + " " + base::toFixedText(stand.value, stand.turns ? 1 : 3) + (stand.turns ? " deg" : " m");
}

std::vector<StateChange> drawChanges(const Route& route, const States& states, int recording, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<RouteJoint> joints = route.joints;
  std::shuffle(joints.begin(), joints.end(), random);
  joints.resize(std::min<std::size_t>(joints.size(), 2 + random() % 2));
  std::vector<StateChange> changes;
  for (const RouteJoint& joint : joints) {
    const double before = states.contains(joint.id) ? states.at(joint.id).value : 0.0;
    const bool closes = before > 0.0 && share(random) < 0.6;
    double value = 0.0;
    while (!closes && std::abs(value - before) < 0.2 * joint.upper) {
      value = (0.25 + 0.7 * share(random)) * joint.upper;
    }
    changes.push_back({joint, value, -1.0});
  }
  if (recording % 2 == 1 && changes.front().joint.seen_s > 0.0) {
    changes.front().at_s = changes.front().joint.seen_s + 0.4 * (share(random) - 0.5);
  }
  return changes;
}

}  // namespace oikos::bench
