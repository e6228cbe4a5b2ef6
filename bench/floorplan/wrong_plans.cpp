// SPDX-License-Identifier: Apache-2.0
#include "bench/floorplan/wrong_plans.h"

#include <functional>

#include "core/base/number_text.h"

namespace oikos::bench {

namespace {

semantic::Home changed(semantic::Home home, const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& change) {
  for (semantic::Room& room : home.rooms) {
    for (Eigen::Vector2d& corner : room.outline_map) {
      corner = change(corner);
    }
  }
  return home;
}

}  // namespace

std::vector<WrongPlan> wrongPlans(const semantic::Home& home, const std::vector<semantic::Home>& others, double moved_m) {
  std::vector<WrongPlan> plans;
  for (const semantic::Home& other : others) {
    plans.push_back({"another home's", other.id, other});
  }
  plans.push_back({"mirrored", "mirrored", changed(home, [](const Eigen::Vector2d& p) { return Eigen::Vector2d(-p.x(), p.y()); })});
  for (const double scale : {0.8, 0.9, 0.95, 1.05, 1.1, 1.25}) {
    plans.push_back({"scaled", "scaled by " + base::toText(scale),
                     changed(home, [&](const Eigen::Vector2d& p) { return Eigen::Vector2d(scale * p); })});
  }
  for (std::size_t r = 0; r < home.rooms.size(); ++r) {
    semantic::Home without = home;
    without.rooms.erase(without.rooms.begin() + static_cast<std::ptrdiff_t>(r));
    plans.push_back({"room left out", "without the " + home.rooms[r].name, without});
    for (const Eigen::Vector2d& direction :
         {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)}) {
      semantic::Home moved = home;
      for (Eigen::Vector2d& corner : moved.rooms[r].outline_map) {
        corner += moved_m * direction;
      }
      plans.push_back(
          {"room moved",
           home.rooms[r].name + " moved by " + base::toText(moved_m * direction.x()) + " " + base::toText(moved_m * direction.y()) + " m",
           moved});
    }
  }
  return plans;
}

}  // namespace oikos::bench
