// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/home_builder.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "core/base/rfc3339.h"

namespace oikos::semantic {

const std::map<std::string_view, HomeBuilder::Method>& HomeBuilder::methods() {
  static const std::map<std::string_view, Method> all{
      {"apartment", &HomeBuilder::apartment},
      {"dock", &HomeBuilder::dock},
      {"term", &HomeBuilder::term},
      {"room", &HomeBuilder::room},
      {"switch", &HomeBuilder::lightSwitch},
      {"largeObject", &HomeBuilder::largeObject},
      {"largeArticulatedObject", &HomeBuilder::articulatedObject},
      {"smallObject", &HomeBuilder::smallObject},
      {"part", &HomeBuilder::part},
      {"joint", &HomeBuilder::joint},
      {"handle", &HomeBuilder::handle},
      {"knob", &HomeBuilder::knob},
      {"state", &HomeBuilder::knobState},
      {"shape", &HomeBuilder::shape},
      {"box", &HomeBuilder::box},
      {"affordance", &HomeBuilder::affordance},
      {"parkingPose", &HomeBuilder::parkingPose},
      {"graspingPoint", &HomeBuilder::graspingPoint},
      {"property", &HomeBuilder::property},
      {"defaultPlace", &HomeBuilder::defaultPlace},
      {"symmetryAxis", &HomeBuilder::symmetryAxis},
  };
  return all;
}

void HomeBuilder::add(const XmlElement& element) {
  close(element.depth);
  element_ = &element;
  if (const auto method = methods().find(element.name); method != methods().end()) {
    (this->*method->second)(Attributes(element, findings_));
  }
}

void HomeBuilder::end(std::string_view name, const std::string& content) {
  if (name == "synonym") {
    vocabulary_.add(term_kind_, {term_, {content}});
  }
}

Home HomeBuilder::take() {
  close(0);
  home_.vocabulary = std::move(vocabulary_);
  return std::move(home_);
}

void HomeBuilder::close(int depth) {
  part_ = part_ != nullptr && depth <= part_depth_ ? nullptr : part_;
  knob_ = knob_ != nullptr && depth <= knob_depth_ ? nullptr : knob_;
  small_ = small_ != nullptr && depth <= small_depth_ ? nullptr : small_;
  if (large_ != nullptr && depth <= large_depth_) {
    takeCarried();
    large_ = nullptr;
  }
  room_ = room_ != nullptr && depth <= room_depth_ ? nullptr : room_;
}

void HomeBuilder::takeCarried() {
  large_->small_objects.assign(std::move_iterator(carried_.begin()), std::move_iterator(carried_.end()));
  carried_.clear();
}

std::optional<std::int64_t> HomeBuilder::time(const char* name, const Attributes& a) {
  const auto text = a.find(name);
  const auto time_ns = text ? base::parseRfc3339Ns(*text) : std::nullopt;
  if (text && !time_ns) {
    const std::string element = "element '" + std::string(element_->name) + "', attribute '" + name + "'";
    const std::string found = std::string("'").append(*text).append("'");
    findings_.push_back({Severity::kError, element_->line, element, found, "a time with its offset, for instance 2026-03-02T08:00:00Z"});
  }
  return time_ns;
}

void HomeBuilder::apartment(const Attributes& a) {
  home_.id = a.text("id");
  home_.name = a.text("name");
  home_.version = static_cast<int>(std::min<std::int64_t>(a.count("version"), std::numeric_limits<int>::max()));
  home_.time_zone = std::string(a.find("timeZone").value_or("UTC"));
  home_.as_of = a.count("asOf");
}

void HomeBuilder::dock(const Attributes& a) {
  home_.T_map_dock = a.pose("pose");
}

void HomeBuilder::term(const Attributes& a) {
  term_kind_ = a.choice<TermKind>("kind");
  term_ = a.text("name");
  const auto stays_for_h = a.hours("staysFor_h");
  if (stays_for_h && term_kind_ != TermKind::kObjectType) {
    findings_.push_back({Severity::kError, element_->line, "element 'term', attribute 'staysFor_h'",
                         "a term of kind '" + std::string(base::toString(term_kind_)) + "'",
                         "a term of kind 'object': nothing else is moved"});
  }
  vocabulary_.add(term_kind_, {term_, {}, stays_for_h});
}

void HomeBuilder::room(const Attributes& a) {
  Room& room = home_.rooms.emplace_back();
  room.id.value = a.text("id");
  room.name = a.text("name");
  room.type = a.text("type");
  room.cloud = a.text("cloud");
  room.outline_map = a.polygon("outline_m");
  room.line = line();
  room_ = &room;
  room_depth_ = element_->depth;
}

void HomeBuilder::lightSwitch(const Attributes& a) {
  if (room_ != nullptr) {
    room_->switches.push_back({a.text("id"), a.choice<SwitchKind>("kind"), a.pose("pose"), line()});
  }
}

void HomeBuilder::largeObject(const Attributes& a) {
  if (room_ == nullptr) {
    return;
  }
  const auto made = std::make_shared<LargeObject>();
  room_->objects.emplace_back(made);
  LargeObject& object = *made;
  object.id.value = a.text("id");
  object.type = a.text("type");
  object.label = a.text("label");
  object.T_map_object = a.pose("pose");
  object.movability = a.choice<Movability>("movability");
  object.graspable = a.flag("graspable");
  object.model = a.text("model");
  object.line = line();
  large_ = &object;
  large_depth_ = element_->depth;
}

void HomeBuilder::articulatedObject(const Attributes& a) {
  largeObject(a);
  if (large_ != nullptr) {
    large_->articulation.emplace();
  }
}

void HomeBuilder::smallObject(const Attributes& a) {
  if (room_ == nullptr) {
    return;
  }
  SmallObject& object = large_ != nullptr ? carried_.emplace_back() : room_->small_objects.emplace_back();
  object.id.value = a.text("id");
  object.type = a.text("type");
  object.label = a.text("label");
  object.parent = a.text("parent");
  object.relation = a.choice<Relation>("relation");
  object.T_parent_object = a.pose("pose");
  object.model = a.text("model");
  object.graspable = a.flag("graspable");
  object.grasp.surface_normal_map = a.vector("surfaceNormal");
  object.grasp.longer_dimension_m = a.length("longerDimension_m");
  object.last_seen_ns = time("lastSeen", a);
  object.confidence = a.share("confidence");
  object.line = line();
  small_ = &object;
  small_depth_ = element_->depth;
}

Articulation* HomeBuilder::articulation() const {
  return large_ != nullptr && large_->articulation ? &*large_->articulation : nullptr;
}

void HomeBuilder::part(const Attributes& a) {
  if (Articulation* const articulated = articulation()) {
    part_ = &articulated->parts.emplace_back();
    *part_ = {{a.text("id")}, a.text("label"), {a.text("parent")}, a.text("model"), {}, line()};
    part_depth_ = element_->depth;
  }
}

void HomeBuilder::joint(const Attributes& a) {
  Articulation* const articulated = articulation();
  if (articulated == nullptr) {
    return;
  }
  Joint joint;
  joint.id.value = a.text("id");
  joint.type = a.choice<JointType>("type");
  joint.parent.value = a.text("parent");
  joint.child.value = a.text("child");
  joint.T_parent_joint = a.pose("origin");
  joint.axis_joint = a.vector("axis").value_or(Eigen::Vector3d::Zero());
  const bool turns = joint.type == JointType::kRevolute;
  bool fits = true;
  const auto inUnit = [&](const char* degrees, const char* metres) {
    const auto value = a.number(turns ? degrees : metres);
    fits = fits && value && !a.find(turns ? metres : degrees);
    return value.value_or(0.0) * (turns ? kRadPerDeg : 1.0);
  };
  joint.lower = inUnit("lower_deg", "lower_m");
  joint.upper = inUnit("upper_deg", "upper_m");
  joint.value = inUnit("value_deg", "value_m");
  joint.line = line();
  if (!fits) {
    findings_.push_back(
        {Severity::kError, element_->line, "joint '" + joint.id.value + "'", "limits or a value that do not fit its type",
         turns ? "lower_deg, upper_deg and value_deg of a revolute joint" : "lower_m, upper_m and value_m of a prismatic joint"});
  }
  articulated->joints.push_back(std::move(joint));
}

void HomeBuilder::handle(const Attributes& a) {
  if (Articulation* const articulated = articulation()) {
    articulated->handles.push_back(
        {a.text("id"), {a.text("part")}, a.choice<HandleKind>("kind"), a.pose("pose"), a.length("length_m"), line()});
  }
}

void HomeBuilder::knob(const Attributes& a) {
  if (Articulation* const articulated = articulation()) {
    knob_ = &articulated->knobs.emplace_back();
    *knob_ = {{a.text("id")},    a.text("label"), {a.text("part")}, a.pose("pose"), a.vector("axis").value_or(Eigen::Vector3d::Zero()), {},
              a.text("current"), line()};
    knob_depth_ = element_->depth;
  }
}

void HomeBuilder::knobState(const Attributes& a) {
  if (knob_ != nullptr) {
    knob_->states.push_back({a.text("name"), a.number("angle_deg").value_or(0.0) * kRadPerDeg});
  }
}

void HomeBuilder::shape(const Attributes& a) {
  std::optional<CopyOnWrite<Shape>>* const place = small_ != nullptr ? &small_->shape : large_ != nullptr ? &large_->shape : nullptr;
  if (place == nullptr) {
    return;
  }
  if (*place) {
    findings_.push_back({Severity::kError, element_->line, "element 'shape'", "a second one of the same piece", "one shape a piece"});
  }
  Shape shape{a.text("kind"), {}};
  for (const auto& [name, value] : a.all()) {
    if (name != "kind") {
      shape.dimensions.push_back({std::string(name), std::string(value)});
    }
  }
  *place = std::move(shape);
}

void HomeBuilder::box(const Attributes& a) {
  const Box box{a.pose("center"), a.size("size_m").value_or(Eigen::Vector3d::Zero())};
  if (small_ != nullptr) {
    small_->box_model = box;
  } else if (part_ != nullptr) {
    part_->boxes_part.push_back(box);
  } else if (large_ != nullptr) {
    large_->boxes_object.push_back(box);
  }
}

void HomeBuilder::affordance(const Attributes& a) {
  if (large_ != nullptr) {
    large_->affordances.push_back(a.text("name"));
  }
}

void HomeBuilder::parkingPose(const Attributes& a) {
  if (large_ != nullptr) {
    large_->parking_poses.push_back({a.pose("pose"), a.flag("default")});
  }
}

void HomeBuilder::graspingPoint(const Attributes& a) {
  const GraspingPoint point{{a.text("part")}, a.pose("pose")};
  if (small_ != nullptr) {
    small_->grasping_points.push_back(point);
  } else if (large_ != nullptr) {
    large_->grasping_points.push_back(point);
  }
}

void HomeBuilder::property(const Attributes& a) {
  if (small_ != nullptr) {
    small_->properties.push_back({a.text("name"), a.text("value")});
  }
}

void HomeBuilder::defaultPlace(const Attributes& a) {
  if (small_ != nullptr) {
    small_->default_places.push_back({a.text("parent"), a.choice<Relation>("relation"), a.pose("pose")});
  }
}

void HomeBuilder::symmetryAxis(const Attributes& a) {
  if (small_ != nullptr) {
    small_->grasp.symmetry_axes_model.push_back(a.vector("direction").value_or(Eigen::Vector3d::Zero()));
  }
}

}  // namespace oikos::semantic
