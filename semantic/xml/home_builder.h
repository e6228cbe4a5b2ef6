// SPDX-License-Identifier: Apache-2.0
// The home's values out of the elements of home.xml, one after the other.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "semantic/model/finding.h"
#include "semantic/model/home.h"
#include "semantic/model/vocabulary.h"
#include "semantic/xml/attributes.h"
#include "semantic/xml/validating_reader.h"

namespace oikos::semantic {

/// Puts each element into the one that is open. An element in the wrong place is the schema's to report; here it goes nowhere. Not
/// thread-safe.
class HomeBuilder {
 public:
  /// An element begins. All that are as deep or deeper have ended.
  void add(const XmlElement& element);
  /// An element with text has ended.
  void end(std::string_view name, const std::string& content);
  /// What was built. Call it once, at the end.
  [[nodiscard]] Home take();
  /// What is lost in the model, so that nobody could tell later.
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

 private:
  using Method = void (HomeBuilder::*)(const Attributes&);
  static const std::map<std::string_view, Method>& methods();

  /// Elements at this depth or deeper have ended.
  void close(int depth);
  /// Gathered apart, in memory that serves for one piece of furniture after another, so that each gets just as much as it needs.
  void takeCarried();
  [[nodiscard]] SourceLine line() const { return {element_->line}; }
  std::optional<std::int64_t> time(const char* name, const Attributes& a);
  /// Of the open piece; null if it has none.
  [[nodiscard]] Articulation* articulation() const;
  // One an element.
  void apartment(const Attributes& a);
  void dock(const Attributes& a);
  void term(const Attributes& a);
  void room(const Attributes& a);
  void lightSwitch(const Attributes& a);
  void largeObject(const Attributes& a);
  void articulatedObject(const Attributes& a);
  void smallObject(const Attributes& a);
  void part(const Attributes& a);
  void joint(const Attributes& a);
  void handle(const Attributes& a);
  void knob(const Attributes& a);
  void knobState(const Attributes& a);
  void shape(const Attributes& a);
  void box(const Attributes& a);
  void affordance(const Attributes& a);
  void parkingPose(const Attributes& a);
  void graspingPoint(const Attributes& a);
  void property(const Attributes& a);
  void defaultPlace(const Attributes& a);
  void symmetryAxis(const Attributes& a);

  std::vector<Finding> findings_;
  Home home_;
  Vocabulary vocabulary_ = builtInVocabulary();
  const XmlElement* element_ = nullptr;
  Room* room_ = nullptr;
  LargeObject* large_ = nullptr;
  std::vector<SmallObject> carried_;  ///< by large_
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

}  // namespace oikos::semantic
