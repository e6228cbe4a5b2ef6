// SPDX-License-Identifier: Apache-2.0
#include "tests/support/random_home.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

namespace oikos::test {

namespace {

using namespace semantic;

class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed) {}

  int upTo(int last) { return static_cast<int>(random_() % static_cast<unsigned>(last + 1)); }
  bool coin() { return upTo(1) == 1; }

  /// With few decimals or with all of them.
  double number() {
    const double value = (static_cast<double>(random_()) / 4294967296.0 - 0.5) * 10.0;
    return coin() ? std::round(value * 100.0) / 100.0 : value;
  }
  double length() { return std::abs(number()); }
  double angle_rad() { return number() * 15.0 * kRadPerDeg; }
  Eigen::Vector3d vector() { return {number(), number(), number()}; }
  Pose pose() {
    Pose made;
    made.position_m = vector();
    made.roll_pitch_yaw_rad = {angle_rad(), angle_rad(), angle_rad()};
    return made;
  }
  Box box() { return {pose(), {length(), length(), length()}}; }
  std::string id(const char* kind) { return kind + std::to_string(next_id_++); }
  std::string text() {
    static const std::vector<std::string> texts{"plain", "two words", "a & b", "<tag>", "\"quoted\" and 'quoted'", "Öl", "tab\there"};
    return texts[static_cast<std::size_t>(upTo(static_cast<int>(texts.size()) - 1))] + std::to_string(upTo(99));
  }
  Eigen::Vector3d axis() { return coin() ? Eigen::Vector3d(1.0, 0.0, 0.0) : Eigen::Vector3d(0.0, 0.0, -1.0); }
  template <class Enum>
  Enum choice() {
    const auto table = enumTable(Enum{});
    return table[static_cast<std::size_t>(upTo(static_cast<int>(table.size()) - 1))].value;
  }
  template <class Make>
  auto some(int most, const Make& make) {
    std::vector<decltype(make())> made;
    for (int i = upTo(most); i > 0; --i) {
      made.push_back(make());
    }
    return made;
  }

  GraspingPoint grasp(const std::string& part) { return {{part}, pose()}; }

  SmallObject smallObject(const std::string& parent, const std::vector<std::string>& places) {
    SmallObject object;
    object.id.value = id("small");
    object.type = coin() ? "cup" : "own_type";
    object.label = coin() ? text() : "";
    object.properties = some(2, [&] { return Property{coin() ? "color" : "owner", coin() ? "blue" : text()}; });
    object.parent = parent;
    object.relation = choice<Relation>();
    object.T_parent_object = pose();
    object.model = coin() ? "models/cup.obj" : "";
    if (coin()) {
      object.shape = Shape{"cup", {{"height_m", coin() ? "0.1" : "0.11"}}};
      if (coin()) {
        object.shape->edit().dimensions.push_back({"outside_rgb", coin() ? "#aabbcc" : "#FF0000"});
      }
    }
    if (coin()) {
      object.box_model = box();
    }
    do {
      object.default_places.push_back(
          {places[static_cast<std::size_t>(upTo(static_cast<int>(places.size()) - 1))], choice<Relation>(), pose()});
    } while (coin());
    object.graspable = coin();
    do {
      object.grasping_points.push_back(grasp(""));
    } while (coin());
    if (coin()) {
      object.grasp.surface_normal_map = axis();
      object.grasp.longer_dimension_m = length();
    }
    object.grasp.symmetry_axes_model = some(2, [&] { return axis(); });
    if (coin()) {
      object.last_seen_ns = std::int64_t{1'700'000'000} * 1'000'000'000 + std::int64_t{1'000} * upTo(1'000'000) * (coin() ? 1 : 1'000'000);
      object.confidence = std::min(length() / 5.0, 1.0);
    }
    return object;
  }

  Articulation articulation() {
    Articulation made;
    const int count = upTo(3);
    for (int i = 0; i <= count; ++i) {
      const PartId parent = i == 0 ? PartId{} : made.parts[static_cast<std::size_t>(upTo(i - 1))].id;
      Part part;
      part.id.value = id("part");
      part.label = coin() ? text() : "";
      part.parent = parent;
      part.model = coin() ? "models/door.obj" : "";
      part.boxes_part = some(2, [&] { return box(); });
      if (i > 0) {
        made.joints.push_back(joint(parent, part.id));
      }
      made.parts.push_back(part);
    }
    const auto anyPart = [&] { return made.parts[static_cast<std::size_t>(upTo(count))].id; };
    made.handles = some(2, [&] {
      Handle handle;
      handle.id = id("handle");
      handle.part = anyPart();
      handle.kind = choice<HandleKind>();
      handle.T_part_handle = pose();
      handle.length_m = coin() ? std::optional(length()) : std::nullopt;
      return handle;
    });
    made.knobs = some(2, [&] { return knob(anyPart()); });
    return made;
  }

  Joint joint(const PartId& parent, const PartId& child) {
    Joint made;
    made.id.value = id("joint");
    made.type = choice<JointType>();
    made.parent = parent;
    made.child = child;
    made.T_parent_joint = pose();
    made.axis_joint = axis();
    const bool turns = made.type == JointType::kRevolute;
    made.lower = turns ? -30.0 * kRadPerDeg : -0.5;
    made.upper = turns ? 120.0 * kRadPerDeg : 0.7;
    made.value = turns ? std::clamp(angle_rad(), made.lower, made.upper) : std::clamp(number(), made.lower, made.upper);
    return made;
  }

  Knob knob(const PartId& part) {
    Knob made;
    made.id.value = id("knob");
    made.label = coin() ? text() : "";
    made.part = part;
    made.T_part_knob = pose();
    made.axis_knob = axis();
    made.states = {{"off", 0.0}, {text(), angle_rad()}};
    made.current = made.states[static_cast<std::size_t>(upTo(1))].name;
    return made;
  }

  LargeObject largeObject(const std::vector<std::string>& rooms) {
    LargeObject object;
    object.id.value = id("large");
    object.type = coin() ? "table" : "own_type";
    object.label = coin() ? text() : "";
    object.T_map_object = pose();
    object.movability = choice<Movability>();
    object.graspable = coin();
    object.model = coin() ? "models/a b.glb" : "";
    if (coin()) {
      object.shape = Shape{"cabinet", {{coin() ? "width_m" : "depth_m", coin() ? "0.80" : "0.7"}, {"hinge", "right"}}};
    }
    object.boxes_object = some(2, [&] { return box(); });
    object.affordances = some(2, [&] { return std::string(coin() ? "sittable" : "own_affordance"); });
    object.parking_poses = some(2, [&] { return ParkingPose{pose(), false}; });
    object.parking_poses.insert(object.parking_poses.begin() + upTo(static_cast<int>(object.parking_poses.size())), {pose(), true});
    std::vector<std::string> carriers{object.id.value};
    if (coin()) {
      object.articulation = articulation();
      for (const Part& part : object.articulation->parts) {
        carriers.push_back(part.id.value);
      }
    }
    object.grasping_points = some(2, [&] { return grasp(object.articulation && coin() ? object.articulation->parts[0].id.value : ""); });
    std::vector<std::string> places = rooms;
    places.insert(places.end(), carriers.begin(), carriers.end());
    object.small_objects =
        some(4, [&] { return smallObject(carriers[static_cast<std::size_t>(upTo(static_cast<int>(carriers.size()) - 1))], places); });
    return object;
  }

  Room room() {
    Room made;
    made.id.value = id("room");
    made.name = text();
    made.type = coin() ? "kitchen" : "";
    made.outline_map = coin() ? std::vector<Eigen::Vector2d>{} : std::vector<Eigen::Vector2d>{{-9, -9}, {9, -9}, {9, 9.25}, {-9, 9}};
    made.cloud = coin() ? "map/rooms/r.ply" : "";
    made.switches = some(2, [&] { return Switch{id("switch"), choice<SwitchKind>(), pose(), {}}; });
    made.objects = some(4, [&] { return CopyOnWrite<LargeObject>(largeObject({made.id.value})); });
    made.small_objects = some(2, [&] { return smallObject(made.id.value, {made.id.value}); });
    return made;
  }

  Home home() {
    Home made;
    made.id = id("home");
    made.name = text();
    made.time_zone = coin() ? "Europe/Rome" : "UTC";
    made.as_of = upTo(3) * 1000;
    made.T_map_dock = coin() ? pose() : Pose{};
    Vocabulary words = builtInVocabulary();
    if (coin()) {
      words.add(choice<TermKind>(), {"own_word", {text(), "other"}});
      words.add(TermKind::kColor, {"blue", {"ultramarine"}});
      words.add(TermKind::kObjectType, {"cup", {}, 0.5 + length()});
      words.add(TermKind::kObjectType, {"own_thing", {}, 0.5 + length()});
    }
    made.vocabulary = words;
    do {
      made.rooms.push_back(room());
    } while (coin());
    return made;
  }

 private:
  std::mt19937 random_;
  int next_id_ = 0;
};

std::vector<SmallObject*> smallObjectsOf(Home& home) {
  std::vector<SmallObject*> all;
  for (Room& room : home.rooms) {
    for (auto& object : room.objects) {
      for (SmallObject& small : object.edit().small_objects) {
        all.push_back(&small);
      }
    }
    for (SmallObject& small : room.small_objects) {
      all.push_back(&small);
    }
  }
  return all;
}

/// Takes one small object out of wherever it is.
std::optional<SmallObject> takeOne(Home& home, Maker& maker) {
  for (Room& room : home.rooms) {
    for (auto& object : room.objects) {
      auto& small = object.edit().small_objects;
      if (!small.empty() && maker.coin()) {
        const auto taken = small.begin() + maker.upTo(static_cast<int>(small.size()) - 1);
        const SmallObject copy = *taken;
        small.erase(taken);
        return copy;
      }
    }
  }
  return std::nullopt;
}

void putSomewhere(Home& home, SmallObject object, Maker& maker) {
  Room& room = home.rooms[static_cast<std::size_t>(maker.upTo(static_cast<int>(home.rooms.size()) - 1))];
  object.T_parent_object = maker.pose();
  if (room.objects.empty() || maker.coin()) {
    object.parent = room.id.value;
    room.small_objects.push_back(object);
    return;
  }
  LargeObject& carrier = room.objects[static_cast<std::size_t>(maker.upTo(static_cast<int>(room.objects.size()) - 1))].edit();
  object.parent = carrier.id.value;
  auto& small = carrier.small_objects;
  small.insert(small.begin() + maker.upTo(static_cast<int>(small.size())), object);
}

void changeFurniture(Home& home, Maker& maker) {
  for (Room& room : home.rooms) {
    for (auto& shared : room.objects) {
      LargeObject& object = shared.edit();
      if (object.articulation && maker.coin()) {
        for (Joint& joint : object.articulation->joints) {
          const double value = joint.type == JointType::kRevolute ? maker.upTo(24) * 5.0 * kRadPerDeg : maker.upTo(10) * 0.05;
          joint.value = std::clamp(value, joint.lower, joint.upper);
        }
        for (Knob& knob : object.articulation->knobs) {
          knob.current = knob.states[static_cast<std::size_t>(maker.upTo(static_cast<int>(knob.states.size()) - 1))].name;
        }
      } else if (maker.coin()) {
        object.T_map_object = maker.pose();
        object.affordances = maker.coin() ? std::vector<std::string>{"sittable"} : std::vector<std::string>{};
      }
    }
  }
}

}  // namespace

Home randomHome(unsigned seed) {
  return Maker(seed).home();
}

Home randomlyChanged(const Home& home, unsigned seed) {
  Maker maker(seed);
  Home changed = home;
  for (int i = maker.upTo(2); i >= 0; --i) {
    const int what = maker.upTo(4);
    if (what == 0) {
      changeFurniture(changed, maker);
    } else if (what == 1) {
      if (auto moved = takeOne(changed, maker)) {
        putSomewhere(changed, *moved, maker);
      }
    } else if (what == 2) {
      SmallObject fresh = maker.smallObject("", {home.rooms[0].id.value});
      fresh.id.value = "new" + std::to_string(seed) + "-" + std::to_string(i);
      putSomewhere(changed, fresh, maker);
    } else if (what == 3) {
      (void)(smallObjectsOf(changed).size() > 3 && takeOne(changed, maker));
    } else {
      for (SmallObject* small : smallObjectsOf(changed)) {
        if (maker.coin()) {
          small->properties = {{"color", maker.text()}};
          small->confidence = 0.25;
        }
      }
    }
  }
  return changed;
}

}  // namespace oikos::test
