// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/articulation_check.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/number_text.h"
#include "semantic/model/check_words.h"
#include "semantic/model/placement.h"

namespace oikos::semantic {

namespace {

class ArticulationChecker {
 public:
  ArticulationChecker(const LargeObject& object, const Articulation& articulation, std::vector<Finding>& findings)
      : object_(object), articulation_(articulation), element_("object " + quoted(object.id.value)), findings_(findings) {}

  void run() {
    const auto bases =
        std::count_if(articulation_.parts.begin(), articulation_.parts.end(), [](const Part& p) { return p.parent.value.empty(); });
    if (bases != 1) {
      error(object_.line.number, element_, std::to_string(bases) + " parts without a parent", "exactly one: the base part");
    }
    for (const Part& part : articulation_.parts) {
      checkPart(part);
    }
    std::set<std::string> moved;
    for (const Joint& joint : articulation_.joints) {
      checkJoint(joint);
      if (!moved.insert(joint.child.value).second) {
        error(joint.line.number, "joint " + quoted(joint.id.value), "a second joint of part " + quoted(joint.child.value),
              "one joint a part");
      }
    }
    for (const Handle& handle : articulation_.handles) {
      if (!hasPart(object_, handle.part.value)) {
        error(handle.line.number, "handle " + quoted(handle.id), "part " + quoted(handle.part.value), "a part of " + element_);
      }
    }
    for (const Knob& knob : articulation_.knobs) {
      checkKnob(knob);
    }
  }

 private:
  void error(int line, std::string element, std::string found, std::string expected) {
    findings_.push_back({Severity::kError, line, std::move(element), std::move(found), std::move(expected)});
  }

  void checkPart(const Part& part) {
    const std::string element = "part " + quoted(part.id.value);
    if (part.parent.value.empty()) {
      return;
    }
    if (!hasPart(object_, part.parent.value)) {
      error(part.line.number, element, "parent " + quoted(part.parent.value), "a part of object " + quoted(object_.id.value));
    } else if (!findPartInObject(articulation_, part.id)) {
      error(part.line.number, element, "a parent that leads back to itself, or to no base part",
            "a chain of parents that ends at the base part");
    }
  }

  void checkJoint(const Joint& joint) {
    const std::string element = "joint " + quoted(joint.id.value);
    const int line = joint.line.number;
    for (const auto& [role, part] : {std::pair("parent", joint.parent.value), std::pair("child", joint.child.value)}) {
      if (!hasPart(object_, part)) {
        error(line, element, role + (" " + quoted(part)), "a part of object " + quoted(object_.id.value));
      }
    }
    const auto child =
        std::find_if(articulation_.parts.begin(), articulation_.parts.end(), [&](const Part& p) { return p.id == joint.child; });
    if (child != articulation_.parts.end() && child->parent != joint.parent) {
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

  void checkKnob(const Knob& knob) {
    const std::string element = "knob " + quoted(knob.id.value);
    if (!hasPart(object_, knob.part.value)) {
      error(knob.line.number, element, "part " + quoted(knob.part.value), "a part of " + element_);
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

  const LargeObject& object_;
  const Articulation& articulation_;
  std::string element_;  ///< the object, in words
  std::vector<Finding>& findings_;
};

}  // namespace

bool hasPart(const LargeObject& object, const std::string& part) {
  return object.articulation && std::any_of(object.articulation->parts.begin(), object.articulation->parts.end(),
                                            [&](const Part& p) { return p.id.value == part; });
}

void checkArticulation(const LargeObject& object, std::vector<Finding>& findings) {
  if (object.articulation) {
    ArticulationChecker(object, *object.articulation, findings).run();
  }
}

}  // namespace oikos::semantic
