// SPDX-License-Identifier: Apache-2.0
// The hierarchy of a home (the user's paper 003, section 3.2.2): apartment, rooms, furniture with its articulation, small objects.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/enum_table.h"
#include "core/model/handle_kind.h"
#include "semantic/model/copy_on_write.h"
#include "semantic/model/pose.h"
#include "semantic/model/vocabulary.h"

namespace oikos::semantic {

/// An id is unique in its whole home, whatever it names; the tag keeps a room's from being taken for an object's.
template <class Tag>
struct Id {
  std::string value;
  auto operator<=>(const Id&) const = default;
};
using RoomId = Id<struct RoomTag>;
using ObjectId = Id<struct ObjectTag>;
using PartId = Id<struct PartTag>;
using JointId = Id<struct JointTag>;
using KnobId = Id<struct KnobTag>;

/// Where an element stands in the file that it was read from; 0: in none. It is no part of the home: two homes that differ in it are equal.
struct SourceLine {
  int number = 0;
  bool operator==(const SourceLine&) const { return true; }
};

enum class Relation { kOn, kIn, kUnder };
constexpr auto enumTable(Relation) {
  return std::to_array<base::EnumName<Relation>>({{Relation::kOn, "on"}, {Relation::kIn, "in"}, {Relation::kUnder, "under"}});
}

enum class Movability { kFixed, kShiftable, kMovable };  ///< whether a piece may serve as a landmark (S220-S223)
constexpr auto enumTable(Movability) {
  return std::to_array<base::EnumName<Movability>>(
      {{Movability::kFixed, "fixed"}, {Movability::kShiftable, "shiftable"}, {Movability::kMovable, "movable"}});
}

enum class JointType { kRevolute, kPrismatic };
constexpr auto enumTable(JointType) {
  return std::to_array<base::EnumName<JointType>>({{JointType::kRevolute, "revolute"}, {JointType::kPrismatic, "prismatic"}});
}

enum class SwitchKind { kRotational, kPrismatic };
constexpr auto enumTable(SwitchKind) {
  return std::to_array<base::EnumName<SwitchKind>>({{SwitchKind::kRotational, "rotational"}, {SwitchKind::kPrismatic, "prismatic"}});
}

using model::HandleKind;

struct GraspingPoint {
  PartId part;  ///< empty: of the object as a whole
  Pose T_part_grasp;
  bool operator==(const GraspingPoint&) const = default;
};

struct Property {
  std::string name;  ///< for instance `color`
  std::string value;
  bool operator==(const Property&) const = default;
};

/// A piece that is described by its dimensions instead of a model file (core/model/furniture).
struct Shape {
  std::string kind;
  std::vector<Property> dimensions;  ///< as they are written
  bool operator==(const Shape&) const = default;
};

/// Where a small object is, or usually is.
struct Placement {
  std::string parent;  ///< id of an object, part or room
  Relation relation = Relation::kOn;
  Pose T_parent_object;
  bool operator==(const Placement&) const = default;
};

/// What a grasp needs to know beside the pose (S281).
struct GraspGeometry {
  std::optional<Eigen::Vector3d> surface_normal_map;  ///< of the supporting surface, length 1
  std::optional<double> longer_dimension_m;
  std::vector<Eigen::Vector3d> symmetry_axes_model;  ///< length 1 each
  bool operator==(const GraspGeometry&) const = default;
};

struct SmallObject {
  ObjectId id;
  std::string type;
  std::string label;
  std::vector<Property> properties;
  std::string parent;  ///< id of the object, part or room that carries it
  Relation relation = Relation::kOn;
  Pose T_parent_object;
  std::string model;  ///< file below the home; empty: none
  std::optional<CopyOnWrite<Shape>> shape;
  std::optional<Box> box_model;
  std::vector<Placement> default_places;  ///< where it is usually found
  bool graspable = false;
  std::vector<GraspingPoint> grasping_points;
  GraspGeometry grasp;
  std::optional<std::int64_t> last_seen_ns;  ///< since 1970, UTC
  std::optional<double> confidence;          ///< 0 to 1
  SourceLine line;
  bool operator==(const SmallObject&) const = default;
};

static_assert(std::is_nothrow_move_constructible_v<SmallObject>);  // a vector of them moves when it grows

struct Part {
  PartId id;
  std::string label;
  PartId parent;  ///< empty: the base part, whose frame is the object's
  std::string model;
  std::vector<Box> boxes_part;  ///< its shape, where there is no model
  SourceLine line;
  bool operator==(const Part&) const = default;
};

/// One degree of freedom between two parts: T_parent_child = T_parent_joint * motion along or about the axis by `value`.
struct Joint {
  JointId id;
  JointType type = JointType::kRevolute;
  PartId parent;
  PartId child;
  Pose T_parent_joint;
  Eigen::Vector3d axis_joint = Eigen::Vector3d::UnitZ();  ///< length 1
  double lower = 0.0;                                     ///< rad or m
  double upper = 0.0;
  double value = 0.0;
  SourceLine line;
  bool operator==(const Joint&) const = default;
};

struct Handle {
  std::string id;
  PartId part;
  HandleKind kind = HandleKind::kBar;
  Pose T_part_handle;
  std::optional<double> length_m;
  SourceLine line;
  bool operator==(const Handle&) const = default;
};

struct KnobState {
  std::string name;
  double angle_rad = 0.0;
  bool operator==(const KnobState&) const = default;
};

/// A knob with its discrete states (S107).
struct Knob {
  KnobId id;
  std::string label;
  PartId part;
  Pose T_part_knob;
  Eigen::Vector3d axis_knob = Eigen::Vector3d::UnitZ();
  std::vector<KnobState> states;
  std::string current;  ///< a state's name
  SourceLine line;
  bool operator==(const Knob&) const = default;
};

/// Where the robot stands to see or reach an object, or what is in or on it (S81).
struct ParkingPose {
  Pose T_object_base;
  bool is_default = false;
  bool operator==(const ParkingPose&) const = default;
};

struct Articulation {
  std::vector<Part> parts;
  std::vector<Joint> joints;
  std::vector<Handle> handles;
  std::vector<Knob> knobs;
  bool operator==(const Articulation&) const = default;
};

/// Furniture and appliances; with an articulation: those that can be opened or set.
struct LargeObject {
  ObjectId id;
  std::string type;
  std::string label;
  Pose T_map_object;
  Movability movability = Movability::kFixed;
  bool graspable = false;
  std::string model;
  std::optional<CopyOnWrite<Shape>> shape;
  std::vector<Box> boxes_object;
  std::vector<std::string> affordances;
  std::vector<ParkingPose> parking_poses;
  std::vector<GraspingPoint> grasping_points;
  std::optional<Articulation> articulation;
  std::vector<SmallObject> small_objects;
  SourceLine line;
  bool operator==(const LargeObject&) const = default;
};

struct Switch {
  std::string id;
  SwitchKind kind = SwitchKind::kRotational;
  Pose T_map_switch;
  SourceLine line;
  bool operator==(const Switch&) const = default;
};

struct Room {
  RoomId id;
  std::string name;
  std::string type;
  std::vector<Eigen::Vector2d> outline_map;  ///< corners in order, either way round (m); empty: not known
  std::string cloud;                         ///< file below the home
  std::vector<Switch> switches;
  std::vector<CopyOnWrite<LargeObject>> objects;
  std::vector<SmallObject> small_objects;  ///< on its floor
  SourceLine line;
  bool operator==(const Room&) const = default;
};

/// The whole home. A plain value: whoever changes one, copies it; the copy shares the furniture that it does not change.
struct Home {
  std::string id;
  std::string name;
  int version = 1;
  std::string time_zone = "UTC";  ///< of the tz database, for questions and answers
  std::int64_t as_of = 0;         ///< the last event of the history that it contains
  Pose T_map_dock;
  CopyOnWrite<Vocabulary> vocabulary;
  std::vector<Room> rooms;
  bool operator==(const Home&) const = default;
};

}  // namespace oikos::semantic
