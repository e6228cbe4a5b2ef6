// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/home_check.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/model/shapes/shape_text.h"
#include "semantic/model/articulation_check.h"
#include "semantic/model/check_words.h"
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
    checkArticulation(object, findings_);
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

}  // namespace oikos::semantic
