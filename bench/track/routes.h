// SPDX-License-Identifier: Apache-2.0
// Short drives through the demo apartment, and what is moved between them and in them.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

namespace oikos::bench {

/// A joint that is in plain view on a route.
struct RouteJoint {
  std::string id;
  double upper = 0.0;  ///< degrees or m
  bool turns = false;
  double seen_s = 0.0;  ///< it is looked at before and after this time of the drive; 0: it is in view too shortly to be moved meanwhile
};

struct Route {
  std::string name;
  std::vector<double> start;
  std::vector<std::string> waypoints;
  std::vector<RouteJoint> joints;
};

/// Through the demo apartment; no joint is opened farther than `free_uppers` has it (degrees or m).
[[nodiscard]] std::vector<Route> routesWithin(const std::map<std::string, double>& free_uppers);

/// Where a joint stands in truth, in the unit of files.
struct Stand {
  double value = 0.0;
  bool turns = true;
};
using States = std::map<std::string, Stand>;

struct StateChange {
  RouteJoint joint;
  double value = 0.0;
  double at_s = -1.0;  ///< below 0: before the drive
};

/// As scripts and `oikos simulate` have it: "oven-door-joint 40.0 deg".
[[nodiscard]] std::string changeText(const std::string& id, const Stand& stand);

/// Two joints or three are moved by a fifth of their range or more, one of them while it is in view in every other recording.
[[nodiscard]] std::vector<StateChange> drawChanges(const Route& route, const States& states, int recording, std::mt19937_64& random);

}  // namespace oikos::bench
