// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/home_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/model/shapes/shape_text.h"
#include "semantic/model/home_models.h"
#include "semantic/model/outline.h"
#include "semantic/model/placement.h"
#include "semantic/model/relations.h"

namespace oikos::semantic {

namespace {

enum class Kind { kRoom, kSwitch, kObject, kPart, kJoint, kHandle, kKnob, kSmallObject };

constexpr const char* nameOf(Kind kind) {
  constexpr std::array<const char*, 8> names{"room", "switch", "object", "part", "joint", "handle", "knob", "small object"};
  return names[static_cast<std::size_t>(kind)];
}

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

bool isDirection(const Eigen::Vector3d& axis) {
  return std::abs(axis.norm() - 1.0) < 1e-3;
}

class Checker {
 public:
  explicit Checker(const Home& home) : home_(home) {}

  std::vector<Finding> run() {
    if (home_.rooms.empty()) {
      error(0, "apartment " + quoted(home_.id), "no room", "at least one");
    }
    collectIds();
    for (const Room& room : home_.rooms) {
      checkRoom(room);
    }
    return std::move(findings_);
  }

 private:
  struct Place {
    Kind kind;
    int line;
  };

  void error(int line, std::string element, std::string found, std::string expected) {
    findings_.push_back({Severity::kError, line, std::move(element), std::move(found), std::move(expected)});
  }
  void warn(int line, std::string element, std::string found, std::string expected) {
    findings_.push_back({Severity::kWarning, line, std::move(element), std::move(found), std::move(expected)});
  }

  void collect(const std::string& id, Kind kind, SourceLine line) {
    const auto [place, is_new] = ids_.try_emplace(id, Place{kind, line.number});
    if (!is_new) {
      error(line.number, nameOf(kind) + (" " + quoted(id)), "an id that is used already",
            "another one: line " + std::to_string(place->second.line) + " has a " + nameOf(place->second.kind) + " of this id");
    }
  }

  void collectIds() {
    std::size_t about = 0;
    for (const Room& room : home_.rooms) {
      for (const LargeObject& object : room.objects) {
        about += 1 + object.small_objects.size();
      }
    }
    ids_.reserve(about);
    for (const Room& room : home_.rooms) {
      collect(room.id.value, Kind::kRoom, room.line);
      for (const Switch& s : room.switches) {
        collect(s.id, Kind::kSwitch, s.line);
      }
      for (const SmallObject& small : room.small_objects) {
        collect(small.id.value, Kind::kSmallObject, small.line);
      }
      for (const LargeObject& object : room.objects) {
        collectIds(object);
      }
    }
  }

  void collectIds(const LargeObject& object) {
    collect(object.id.value, Kind::kObject, object.line);
    if (object.articulation) {
      for (const Part& part : object.articulation->parts) {
        collect(part.id.value, Kind::kPart, part.line);
      }
      for (const Joint& joint : object.articulation->joints) {
        collect(joint.id.value, Kind::kJoint, joint.line);
      }
      for (const Handle& handle : object.articulation->handles) {
        collect(handle.id, Kind::kHandle, handle.line);
      }
      for (const Knob& knob : object.articulation->knobs) {
        collect(knob.id.value, Kind::kKnob, knob.line);
      }
    }
    for (const SmallObject& small : object.small_objects) {
      collect(small.id.value, Kind::kSmallObject, small.line);
    }
  }

  bool isKnown(TermKind kind, std::string_view word) {
    const auto [known, is_new] = known_words_.try_emplace({kind, word}, false);
    known->second = is_new ? home_.vocabulary->find(kind, word) != nullptr : known->second;
    return known->second;
  }

  void checkWord(TermKind kind, const std::string& word, const std::string& element, int line) {
    if (word.empty() || isKnown(kind, word)) {
      return;
    }
    std::vector<std::string> names;
    for (const Term& term : home_.vocabulary->of(kind)) {
      names.push_back(term.name);
    }
    const std::string kind_name(base::toString(kind));
    warn(line, element, kind_name + " " + quoted(word) + ", which the vocabulary lacks" + base::didYouMean(word, names),
         "a known word, or <term kind=\"" + kind_name + "\" name=\"" + word + "\"/> in <vocabulary>");
  }

  void checkRoom(const Room& room) {
    checkWord(TermKind::kRoomType, room.type, "room " + quoted(room.id.value), room.line.number);
    for (const LargeObject& object : room.objects) {
      checkObject(room, object);
    }
    for (const SmallObject& small : room.small_objects) {
      if (small.parent != room.id.value) {
        error(small.line.number, "small object " + quoted(small.id.value), "parent " + quoted(small.parent),
              quoted(room.id.value) + ", the room whose floor it lies on");
      }
      checkSmallObject(small);
    }
  }

  void checkObject(const Room& room, const LargeObject& object) {
    const std::string element = "object " + quoted(object.id.value);
    const int line = object.line.number;
    checkWord(TermKind::kObjectType, object.type, element, line);
    for (const std::string& affordance : object.affordances) {
      checkWord(TermKind::kAffordance, affordance, element, line);
    }
    constexpr double kWithinWall_m = 0.15;  // as a door's frame is
    const Eigen::Vector2d place_map = object.T_map_object.position_m.head<2>();
    if (!room.outline_map.empty() && !isInside(place_map, room.outline_map) &&
        distanceToEdge(place_map, room.outline_map) > kWithinWall_m) {
      warn(line, element,
           "at x " + base::toFixedText(object.T_map_object.position_m.x(), 2) + ", y " +
               base::toFixedText(object.T_map_object.position_m.y(), 2) + " m, outside its room",
           "within the outline of room " + quoted(room.id.value));
    }
    const auto defaults =
        std::count_if(object.parking_poses.begin(), object.parking_poses.end(), [](const ParkingPose& p) { return p.is_default; });
    if (defaults != 1) {
      error(line, element, std::to_string(defaults) + " default parking poses", "exactly one <parkingPose default=\"true\">");
    }
    if (object.articulation) {
      checkArticulation(*object.articulation, object, element);
    }
    checkShape(object.shape, element, line);
    checkGraspingPoints(object.grasping_points, object, element, line);
    for (const SmallObject& small : object.small_objects) {
      checkCarried(small, object);
    }
  }

  void checkShape(const std::optional<CopyOnWrite<Shape>>& shape, const std::string& element, int line) {
    if (shape) {
      for (const std::string& fault : model::validateShape((*shape)->kind, dimensionsOf(**shape))) {
        error(line, element, "shape: " + fault, "");
      }
    }
  }

  void checkGraspingPoints(const std::vector<GraspingPoint>& points, const LargeObject& object, const std::string& element, int line) {
    for (const GraspingPoint& point : points) {
      if (!point.part.value.empty() && !hasPart(object, point.part.value)) {
        error(line, element, "a grasping point on part " + quoted(point.part.value), "a part of this object");
      }
    }
  }

  [[nodiscard]] static bool hasPart(const LargeObject& object, const std::string& part) {
    return object.articulation && std::any_of(object.articulation->parts.begin(), object.articulation->parts.end(),
                                              [&](const Part& p) { return p.id.value == part; });
  }

  void checkArticulation(const Articulation& articulation, const LargeObject& object, const std::string& element) {
    const auto bases =
        std::count_if(articulation.parts.begin(), articulation.parts.end(), [](const Part& p) { return p.parent.value.empty(); });
    if (bases != 1) {
      error(object.line.number, element, std::to_string(bases) + " parts without a parent", "exactly one: the base part");
    }
    for (const Part& part : articulation.parts) {
      checkPart(part, articulation, object);
    }
    std::set<std::string> moved;
    for (const Joint& joint : articulation.joints) {
      checkJoint(joint, articulation, object);
      if (!moved.insert(joint.child.value).second) {
        error(joint.line.number, "joint " + quoted(joint.id.value), "a second joint of part " + quoted(joint.child.value),
              "one joint a part");
      }
    }
    for (const Handle& handle : articulation.handles) {
      if (!hasPart(object, handle.part.value)) {
        error(handle.line.number, "handle " + quoted(handle.id), "part " + quoted(handle.part.value), "a part of " + element);
      }
    }
    for (const Knob& knob : articulation.knobs) {
      checkKnob(knob, object, element);
    }
  }

  void checkPart(const Part& part, const Articulation& articulation, const LargeObject& object) {
    const std::string element = "part " + quoted(part.id.value);
    if (part.parent.value.empty()) {
      return;
    }
    if (!hasPart(object, part.parent.value)) {
      error(part.line.number, element, "parent " + quoted(part.parent.value), "a part of object " + quoted(object.id.value));
    } else if (!findPartInObject(articulation, part.id)) {
      error(part.line.number, element, "a parent that leads back to itself, or to no base part",
            "a chain of parents that ends at the base part");
    }
  }

  void checkJoint(const Joint& joint, const Articulation& articulation, const LargeObject& object) {
    const std::string element = "joint " + quoted(joint.id.value);
    const int line = joint.line.number;
    for (const auto& [role, part] : {std::pair("parent", joint.parent.value), std::pair("child", joint.child.value)}) {
      if (!hasPart(object, part)) {
        error(line, element, role + (" " + quoted(part)), "a part of object " + quoted(object.id.value));
      }
    }
    const auto child =
        std::find_if(articulation.parts.begin(), articulation.parts.end(), [&](const Part& p) { return p.id == joint.child; });
    if (child != articulation.parts.end() && child->parent != joint.parent) {
      error(line, element, "parent " + quoted(joint.parent.value) + " of a part whose parent is " + quoted(child->parent.value),
            "the same");
    }
    if (!isDirection(joint.axis_joint)) {
      error(line, element, "an axis of length " + base::toFixedText(joint.axis_joint.norm(), 4), "length 1");
    }
    const bool turns = joint.type == JointType::kRevolute;
    const auto text = [&](double value) {
      return base::toText(std::round((turns ? value / kRadPerDeg : value) * 1e6) / 1e6) + (turns ? " deg" : " m");
    };
    constexpr double kSlack = 1e-9;
    if (joint.lower > joint.upper) {
      error(line, element, "limits " + text(joint.lower) + " to " + text(joint.upper), "the lower one first");
    } else if (joint.value < joint.lower - kSlack || joint.value > joint.upper + kSlack) {
      error(line, element, "value " + text(joint.value), "within " + text(joint.lower) + " to " + text(joint.upper));
    }
  }

  void checkKnob(const Knob& knob, const LargeObject& object, const std::string& object_name) {
    const std::string element = "knob " + quoted(knob.id.value);
    if (!hasPart(object, knob.part.value)) {
      error(knob.line.number, element, "part " + quoted(knob.part.value), "a part of " + object_name);
    }
    if (!isDirection(knob.axis_knob)) {
      error(knob.line.number, element, "an axis of length " + base::toFixedText(knob.axis_knob.norm(), 4), "length 1");
    }
    std::set<std::string> names;
    std::string all;
    for (const KnobState& state : knob.states) {
      if (!names.insert(state.name).second) {
        error(knob.line.number, element, "two states " + quoted(state.name), "a name of its own for each");
      }
      all += (all.empty() ? "" : ", ") + state.name;
    }
    if (!names.contains(knob.current)) {
      error(knob.line.number, element, "current state " + quoted(knob.current), "one of " + all);
    }
  }

  void checkCarried(const SmallObject& small, const LargeObject& object) {
    const auto T_map_carrier = findCarrierInMap(object, small.parent);
    if (!T_map_carrier) {
      error(small.line.number, "small object " + quoted(small.id.value), "parent " + quoted(small.parent),
            quoted(object.id.value) + " or one of its parts: it stands inside that element");
    } else {
      checkRelation(small, object);
    }
    checkSmallObject(small);
  }

  void checkRelation(const SmallObject& small, const LargeObject& object) {
    const std::vector<Box> boxes = boxesOf(object, small.parent);
    const std::vector<SpatialRelation> seen = spatialRelations(boxes, small.T_parent_object.toIsometry(), small.box_model);
    const std::string_view stored = base::toString(small.relation);
    const auto is_stored = [&](SpatialRelation relation) { return base::toString(relation) == stored; };
    if (!boxes.empty() && std::none_of(seen.begin(), seen.end(), is_stored)) {
      warn(small.line.number, "small object " + quoted(small.id.value),
           "relation " + quoted(std::string(stored)) + " to " + quoted(small.parent),
           "by their boxes it is " + (seen.empty() ? "far from" : std::string(base::toString(seen.front()))) + " it");
    }
  }

  void checkSmallObject(const SmallObject& small) {
    const std::string element = "small object " + quoted(small.id.value);
    const int line = small.line.number;
    checkWord(TermKind::kObjectType, small.type, element, line);
    for (const Property& property : small.properties) {
      if (property.name == "color") {
        checkWord(TermKind::kColor, property.value, element, line);
      }
    }
    checkShape(small.shape, element, line);
    if (small.default_places.empty()) {
      error(line, element, "no default place", "at least one <defaultPlace>");
    }
    for (const Placement& place : small.default_places) {
      const auto found = ids_.find(place.parent);
      if (found == ids_.end() ||
          (found->second.kind != Kind::kObject && found->second.kind != Kind::kPart && found->second.kind != Kind::kRoom)) {
        error(line, element, "a default place at " + quoted(place.parent), "the id of an object, a part or a room");
      }
    }
    if (small.graspable && small.grasping_points.empty()) {
      error(line, element, "graspable, but no grasping point", "at least one <graspingPoint>");
    }
    for (const Eigen::Vector3d& axis : small.grasp.symmetry_axes_model) {
      if (!isDirection(axis)) {
        error(line, element, "a symmetry axis of length " + base::toFixedText(axis.norm(), 4), "length 1");
      }
    }
    if (small.grasp.surface_normal_map && !isDirection(*small.grasp.surface_normal_map)) {
      error(line, element, "a surface normal of length " + base::toFixedText(small.grasp.surface_normal_map->norm(), 4), "length 1");
    }
  }

  const Home& home_;
  std::vector<Finding> findings_;
  std::map<std::pair<TermKind, std::string_view>, bool> known_words_;
  std::unordered_map<std::string_view, Place> ids_;  // looked up only, never walked through
};

}  // namespace

std::vector<Finding> checkHome(const Home& home) {
  return Checker(home).run();
}

std::vector<Finding> checkFiles(const Home& home, const std::filesystem::path& folder) {
  std::vector<Finding> findings;
  std::map<std::string, bool> is_there;
  const auto check = [&](const std::string& file, const std::string& element, SourceLine line) {
    if (file.empty()) {
      return;
    }
    std::error_code ignored;
    const auto [entry, is_new] = is_there.try_emplace(file, false);
    entry->second = is_new ? std::filesystem::is_regular_file(folder / file, ignored) : entry->second;
    if (!entry->second) {
      findings.push_back({Severity::kWarning, line.number, element, "'" + file + "', which is missing", "a file below the home's folder"});
    }
  };
  for (const Room& room : home.rooms) {
    check(room.cloud, "room " + quoted(room.id.value), room.line);
    for (const SmallObject& small : room.small_objects) {
      check(small.model, "small object " + quoted(small.id.value), small.line);
    }
    for (const LargeObject& object : room.objects) {
      check(object.model, "object " + quoted(object.id.value), object.line);
      for (const Part& part : object.articulation ? object.articulation->parts : std::vector<Part>{}) {
        check(part.model, "part " + quoted(part.id.value), part.line);
      }
      for (const SmallObject& small : object.small_objects) {
        check(small.model, "small object " + quoted(small.id.value), small.line);
      }
    }
  }
  return findings;
}

}  // namespace oikos::semantic
