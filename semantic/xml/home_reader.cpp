// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/home_reader.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/posix_file.h"
#include "core/base/rfc3339.h"
#include "semantic/model/home_check.h"
#include "semantic/xml/attributes.h"
#include "semantic/xml/home_schema.h"
#include "semantic/xml/validating_reader.h"

namespace oikos::semantic {

namespace {

/// Puts each element into the one that is open. An element in the wrong place is the schema's to report; here it goes nowhere.
class Builder {
 public:
  void add(const XmlElement& element) {
    close(element.depth);
    element_ = &element;
    if (const auto method = methods().find(element.name); method != methods().end()) {
      (this->*method->second)(Attributes(element, findings));
    }
  }

  void end(std::string_view name, const std::string& content) {
    if (name == "synonym") {
      vocabulary_.add(term_kind_, {term_, {content}});
    }
  }

  Home take() {
    close(0);
    home_.vocabulary = std::move(vocabulary_);
    return std::move(home_);
  }

 private:
  using Method = void (Builder::*)(const Attributes&);
  static const std::map<std::string_view, Method>& methods() {
    static const std::map<std::string_view, Method> all{
        {"apartment", &Builder::apartment},
        {"dock", &Builder::dock},
        {"term", &Builder::term},
        {"room", &Builder::room},
        {"switch", &Builder::lightSwitch},
        {"largeObject", &Builder::largeObject},
        {"largeArticulatedObject", &Builder::articulatedObject},
        {"smallObject", &Builder::smallObject},
        {"part", &Builder::part},
        {"joint", &Builder::joint},
        {"handle", &Builder::handle},
        {"knob", &Builder::knob},
        {"state", &Builder::knobState},
        {"shape", &Builder::shape},
        {"box", &Builder::box},
        {"affordance", &Builder::affordance},
        {"parkingPose", &Builder::parkingPose},
        {"graspingPoint", &Builder::graspingPoint},
        {"property", &Builder::property},
        {"defaultPlace", &Builder::defaultPlace},
        {"symmetryAxis", &Builder::symmetryAxis},
    };
    return all;
  }

  /// Elements at this depth or deeper have ended.
  void close(int depth) {
    part_ = part_ != nullptr && depth <= part_depth_ ? nullptr : part_;
    knob_ = knob_ != nullptr && depth <= knob_depth_ ? nullptr : knob_;
    small_ = small_ != nullptr && depth <= small_depth_ ? nullptr : small_;
    if (large_ != nullptr && depth <= large_depth_) {
      takeCarried();
      large_ = nullptr;
    }
    room_ = room_ != nullptr && depth <= room_depth_ ? nullptr : room_;
  }

  /// Gathered apart, in memory that serves for one piece of furniture after another, so that each gets just as much as it needs.
  void takeCarried() {
    large_->small_objects.assign(std::move_iterator(carried_.begin()), std::move_iterator(carried_.end()));
    carried_.clear();
  }

  [[nodiscard]] SourceLine line() const { return {element_->line}; }

  std::optional<std::int64_t> time(const char* name, const Attributes& a) {
    const auto text = a.find(name);
    const auto time_ns = text ? base::parseRfc3339Ns(*text) : std::nullopt;
    if (text && !time_ns) {
      const std::string element = "element '" + std::string(element_->name) + "', attribute '" + name + "'";
      const std::string found = std::string("'").append(*text).append("'");
      findings.push_back({Severity::kError, element_->line, element, found, "a time with its offset, for instance 2026-03-02T08:00:00Z"});
    }
    return time_ns;
  }

  void apartment(const Attributes& a) {
    home_.id = a.text("id");
    home_.name = a.text("name");
    home_.version = static_cast<int>(std::min<std::int64_t>(a.count("version"), std::numeric_limits<int>::max()));
    home_.time_zone = std::string(a.find("timeZone").value_or("UTC"));
    home_.as_of = a.count("asOf");
  }

  void dock(const Attributes& a) { home_.T_map_dock = a.pose("pose"); }

  void term(const Attributes& a) {
    term_kind_ = a.choice<TermKind>("kind");
    term_ = a.text("name");
    const auto stays_for_h = a.hours("staysFor_h");
    if (stays_for_h && term_kind_ != TermKind::kObjectType) {
      findings.push_back({Severity::kError, element_->line, "element 'term', attribute 'staysFor_h'",
                          "a term of kind '" + std::string(base::toString(term_kind_)) + "'",
                          "a term of kind 'object': nothing else is moved"});
    }
    vocabulary_.add(term_kind_, {term_, {}, stays_for_h});
  }

  void room(const Attributes& a) {
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

  void lightSwitch(const Attributes& a) {
    if (room_ != nullptr) {
      room_->switches.push_back({a.text("id"), a.choice<SwitchKind>("kind"), a.pose("pose"), line()});
    }
  }

  void largeObject(const Attributes& a) {
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

  void articulatedObject(const Attributes& a) {
    largeObject(a);
    if (large_ != nullptr) {
      large_->articulation.emplace();
    }
  }

  void smallObject(const Attributes& a) {
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

  [[nodiscard]] Articulation* articulation() const { return large_ != nullptr && large_->articulation ? &*large_->articulation : nullptr; }

  void part(const Attributes& a) {
    if (Articulation* const articulated = articulation()) {
      part_ = &articulated->parts.emplace_back();
      *part_ = {{a.text("id")}, a.text("label"), {a.text("parent")}, a.text("model"), {}, line()};
      part_depth_ = element_->depth;
    }
  }

  void joint(const Attributes& a) {
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
      findings.push_back(
          {Severity::kError, element_->line, "joint '" + joint.id.value + "'", "limits or a value that do not fit its type",
           turns ? "lower_deg, upper_deg and value_deg of a revolute joint" : "lower_m, upper_m and value_m of a prismatic joint"});
    }
    articulated->joints.push_back(std::move(joint));
  }

  void handle(const Attributes& a) {
    if (Articulation* const articulated = articulation()) {
      articulated->handles.push_back(
          {a.text("id"), {a.text("part")}, a.choice<HandleKind>("kind"), a.pose("pose"), a.length("length_m"), line()});
    }
  }

  void knob(const Attributes& a) {
    if (Articulation* const articulated = articulation()) {
      knob_ = &articulated->knobs.emplace_back();
      *knob_ = {
          {a.text("id")},    a.text("label"), {a.text("part")}, a.pose("pose"), a.vector("axis").value_or(Eigen::Vector3d::Zero()), {},
          a.text("current"), line()};
      knob_depth_ = element_->depth;
    }
  }

  void knobState(const Attributes& a) {
    if (knob_ != nullptr) {
      knob_->states.push_back({a.text("name"), a.number("angle_deg").value_or(0.0) * kRadPerDeg});
    }
  }

  void shape(const Attributes& a) {
    std::optional<CopyOnWrite<Shape>>* const place = small_ != nullptr ? &small_->shape : large_ != nullptr ? &large_->shape : nullptr;
    if (place == nullptr) {
      return;
    }
    if (*place) {
      findings.push_back({Severity::kError, element_->line, "element 'shape'", "a second one of the same piece", "one shape a piece"});
    }
    Shape shape{a.text("kind"), {}};
    for (const auto& [name, value] : a.all()) {
      if (name != "kind") {
        shape.dimensions.push_back({std::string(name), std::string(value)});
      }
    }
    *place = std::move(shape);
  }

  void box(const Attributes& a) {
    const Box box{a.pose("center"), a.size("size_m").value_or(Eigen::Vector3d::Zero())};
    if (small_ != nullptr) {
      small_->box_model = box;
    } else if (part_ != nullptr) {
      part_->boxes_part.push_back(box);
    } else if (large_ != nullptr) {
      large_->boxes_object.push_back(box);
    }
  }

  void affordance(const Attributes& a) {
    if (large_ != nullptr) {
      large_->affordances.push_back(a.text("name"));
    }
  }

  void parkingPose(const Attributes& a) {
    if (large_ != nullptr) {
      large_->parking_poses.push_back({a.pose("pose"), a.flag("default")});
    }
  }

  void graspingPoint(const Attributes& a) {
    const GraspingPoint point{{a.text("part")}, a.pose("pose")};
    if (small_ != nullptr) {
      small_->grasping_points.push_back(point);
    } else if (large_ != nullptr) {
      large_->grasping_points.push_back(point);
    }
  }

  void property(const Attributes& a) {
    if (small_ != nullptr) {
      small_->properties.push_back({a.text("name"), a.text("value")});
    }
  }

  void defaultPlace(const Attributes& a) {
    if (small_ != nullptr) {
      small_->default_places.push_back({a.text("parent"), a.choice<Relation>("relation"), a.pose("pose")});
    }
  }

  void symmetryAxis(const Attributes& a) {
    if (small_ != nullptr) {
      small_->grasp.symmetry_axes_model.push_back(a.vector("direction").value_or(Eigen::Vector3d::Zero()));
    }
  }

 public:
  std::vector<Finding> findings;  ///< what is lost in the model, so that nobody could tell later

 private:
  Home home_;
  Vocabulary vocabulary_ = builtInVocabulary();
  const XmlElement* element_ = nullptr;
  Room* room_ = nullptr;
  LargeObject* large_ = nullptr;
  std::vector<SmallObject> carried_;  // by large_
  SmallObject* small_ = nullptr;
  Part* part_ = nullptr;
  Knob* knob_ = nullptr;
  int room_depth_ = 0;
  int large_depth_ = 0;
  int small_depth_ = 0;
  int part_depth_ = 0;
  int knob_depth_ = 0;
  TermKind term_kind_ = TermKind::kObjectType;
  std::string term_;
};

HomeReading read(std::istream& input, const std::string& where) {
  Builder builder;
  const XmlReading xml = readValidated(input, where, homeSchema(),
                                       {[&](const XmlElement& element) { builder.add(element); },
                                        [&](std::string_view name, const std::string& content) { builder.end(name, content); }});
  HomeReading reading{xml.complete, builder.take(), xml.findings};
  reading.findings.insert(reading.findings.end(), builder.findings.begin(), builder.findings.end());
  if (reading.complete) {
    const std::vector<Finding> checked = checkHome(reading.home);
    reading.findings.insert(reading.findings.end(), checked.begin(), checked.end());
  }
  std::stable_sort(reading.findings.begin(), reading.findings.end(), [](const Finding& a, const Finding& b) { return a.line < b.line; });
  return reading;
}

}  // namespace

HomeReading readHome(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  if (!input || std::filesystem::is_directory(file)) {
    throw base::Error(base::ErrorCode::kIo, "cannot be opened", file.string());
  }
  return read(input, file.string());
}

HomeReading readHomeText(const std::string& text, const std::string& where) {
  std::istringstream input(text);
  return read(input, where);
}

Home getHome(HomeReading reading, const std::filesystem::path& file) {
  for (const Finding& finding : reading.findings) {
    if (finding.severity == Severity::kError) {
      throw base::Error(base::ErrorCode::kInput,
                        finding.element + ": " + finding.found + (finding.expected.empty() ? "" : "; expected " + finding.expected) +
                            " (oikos check " + base::folderOf(file).string() + " lists everything)",
                        file.string() + ":" + std::to_string(finding.line));
    }
  }
  OIKOS_CHECK(reading.complete);
  return std::move(reading.home);
}

}  // namespace oikos::semantic
