// SPDX-License-Identifier: Apache-2.0
// Short ways of a camera past what carries small objects.
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "semantic/model/home.h"
#include "tools/simulate/world.h"

namespace oikos::bench {

/// What is on a piece of furniture, and where that is in truth.
struct Carrier {
  std::string id;
  Eigen::AlignedBox3d around_map;  ///< of the objects' places
  std::set<std::string> objects;
};

/// Those that nobody carries away.
[[nodiscard]] std::vector<Carrier> carriersOf(const semantic::Home& home);

/// T_map_camera of so many images from 0.9 to 2.4 m, 13 to 28 cm apart; empty: there is no room for them.
[[nodiscard]] std::vector<Eigen::Isometry3d> drivePast(const Carrier& carrier, const simulate::World& world, int views,
                                                       std::mt19937_64& random);

}  // namespace oikos::bench
