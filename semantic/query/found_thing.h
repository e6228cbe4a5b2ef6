// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "semantic/query/home_index.h"

namespace oikos::semantic {

struct JointReading {
  std::string id;
  JointType type = JointType::kRevolute;
  double value = 0.0;  ///< rad or m
};

/// All that is known of one thing in an answer.
struct FoundThing {
  std::string id;
  std::string name;
  std::string room;    ///< id
  std::string parent;  ///< id; empty: none
  std::optional<Relation> relation;
  Eigen::Isometry3d T_map_thing = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> T_parent_thing;
  std::vector<Eigen::Isometry3d> T_map_base;  ///< parking poses in the order to try them
  std::vector<JointReading> joints_to_move;   ///< closed ones in the way, outermost first
  std::vector<JointReading> joints;           ///< its own, where the question is of its state
  std::string setting;                        ///< of a knob
  std::optional<std::int64_t> last_seen_ns;
  std::optional<double> confidence;
};

/// A value of its own: the home may go.
[[nodiscard]] FoundThing describe(const Thing& thing);

/// The joints whose state is the thing's: all of a piece of furniture, that of a part; else none.
[[nodiscard]] std::vector<const Joint*> jointsOf(const Thing& thing);
/// How far from where it is shut: at 0, or the limit nearest to it (rad or m).
[[nodiscard]] double openingOf(const Joint& joint);
/// Farther open than a reading may be off: 5 degrees, 2 cm.
[[nodiscard]] bool isOpen(const Joint& joint);

}  // namespace oikos::semantic
