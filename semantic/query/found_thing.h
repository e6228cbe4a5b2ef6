// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "semantic/history/belief.h"
#include "semantic/query/thing.h"

namespace oikos::semantic {

struct RobotPlace {
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();
  double yaw_map_rad = 0.0;
};

struct JointReading {
  std::string id;
  JointType type = JointType::kRevolute;
  double value = 0.0;  ///< rad or m
};

struct HandlePlace {
  std::string id;
  HandleKind kind = HandleKind::kBar;
  Eigen::Isometry3d T_map_handle = Eigen::Isometry3d::Identity();
};

/// What an answer rests on.
struct Evidence {
  std::int64_t event = 0;             ///< number in the history
  std::string recording;              ///< empty: of none
  std::optional<std::int64_t> frame;  ///< of the recording
  std::string picture;                ///< file below the home; empty: none
};

/// All that is known of one thing in an answer.
struct FoundThing {
  std::string id;
  std::string name;
  std::string type;    ///< of furniture and small objects
  std::string room;    ///< id
  std::string parent;  ///< id; empty: none
  std::optional<Relation> relation;
  Eigen::Isometry3d T_map_thing = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> T_parent_thing;
  std::vector<Eigen::Isometry3d> T_map_base;   ///< parking poses in the order to try them
  std::vector<JointReading> joints_to_move;    ///< closed ones in the way, outermost first
  std::vector<JointReading> joints;            ///< its own, where the question is of its state
  std::vector<HandlePlace> handles;            ///< to open it by
  std::vector<Eigen::Isometry3d> T_map_grasp;  ///< where it can be grasped
  std::vector<Placement> usual_places;
  std::string setting;  ///< of a knob
  std::optional<std::int64_t> last_seen_ns;
  std::optional<std::int64_t> missed_ns;      ///< of a small object: when it was looked for there in vain, if nothing was heard of it since
  std::optional<double> confidence;           ///< of a small object: the probability that it is there still
  std::vector<PlaceProbability> expected_at;  ///< from 0.01 on, the most probable first
  std::optional<double> elsewhere;            ///< the probability of a place where it was never seen and does not belong
  std::optional<Evidence> evidence;
};

/// A value of its own: the home may go. Parking poses with the default first, or the nearest to the robot.
[[nodiscard]] FoundThing describe(const Thing& thing, const std::optional<RobotPlace>& robot = std::nullopt);

/// The joints whose state is the thing's: all of a piece of furniture, that of a part; else none.
[[nodiscard]] std::vector<const Joint*> jointsOf(const Thing& thing);
/// Its own, those of its furniture's or part's parts, or itself.
[[nodiscard]] std::vector<const Knob*> knobsOf(const Thing& thing);
/// What stands between the robot and a small object: the shut joints of its drawer; in a body with doors, the nearest
/// door (by the middle between its hinge and its handle) if it is shut, both of two that are equally near (5 cm).
[[nodiscard]] std::vector<const Joint*> jointsInTheWay(const Thing& thing);
/// Of the part that the joint moves.
[[nodiscard]] std::vector<HandlePlace> handlesOf(const LargeObject& object, const Joint& joint);
/// How far from where it is shut: at 0, or the limit nearest to it (rad or m).
[[nodiscard]] double openingOf(const Joint& joint);
/// Farther open than a reading may be off: 5 degrees, 2 cm.
[[nodiscard]] bool isOpen(const Joint& joint);
/// Whether any of its joints is; nothing: it has none.
[[nodiscard]] std::optional<bool> isOpen(const Thing& thing);

}  // namespace oikos::semantic
