// SPDX-License-Identifier: Apache-2.0
// The dimensions of a parametric shape as text. A shape names its fields once, as they are written:
//
//     template <class Visitor>
//     void visit(Visitor&& visitor) {
//       visitor.length("width_m", width_m).count("door_count", door_count).choice("hinge", hinge);
//       visitor.angle("door_opening_deg", door_opening_rad).color("front_rgb", front_rgb);
//     }
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/enum_table.h"

namespace oikos::model {

// Each kind of field: `text` as it is written, `set` from what is written (false: it is none of its kind, and nothing changes), and
// `rule`, what would be right. They point into the shape that they were listed from.

struct NumberField {
  double* value;
  const char* unit;  ///< "m", or empty for a ratio

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool set(std::string_view text) const;
  [[nodiscard]] std::string rule() const;
};

/// Written in degrees.
struct AngleField {
  double* value_rad;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool set(std::string_view text) const;
  [[nodiscard]] std::string rule() const;
};

struct CountField {
  int* value;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool set(std::string_view text) const;
  [[nodiscard]] std::string rule() const;
};

/// Written as `#D8CBB2`.
struct ColorField {
  std::uint32_t* rgb;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool set(std::string_view text) const;
  [[nodiscard]] std::string rule() const;
};

/// Separated by spaces; empty: none.
struct LengthsField {
  std::vector<double>* values_m;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool set(std::string_view text) const;
  [[nodiscard]] std::string rule() const;
};

/// An enum with a table, its type erased.
struct ChoiceField {
  void* value;
  std::string_view (*name_of)(const void* value);
  bool (*assign)(void* value, std::string_view name);
  std::vector<std::string> (*names)();

  template <base::NamedEnum Enum>
  [[nodiscard]] static ChoiceField of(Enum& value) {
    return {&value, [](const void* place) { return base::toString(*static_cast<const Enum*>(place)); },
            [](void* place, std::string_view name) {
              const auto found = base::findEnum<Enum>(name);
              *static_cast<Enum*>(place) = found.value_or(*static_cast<Enum*>(place));
              return found.has_value();
            },
            base::enumNames<Enum>};
  }

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool set(std::string_view text) const;
  [[nodiscard]] std::string rule() const;
};

struct ShapeField {
  std::string_view name;
  std::variant<NumberField, AngleField, CountField, ColorField, LengthsField, ChoiceField> target;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool set(std::string_view text) const;
  [[nodiscard]] std::string rule() const;
};

/// The visitor that lists a shape's fields in their order.
class ShapeFieldLister {
 public:
  ShapeFieldLister& length(std::string_view name, double& value_m) { return add({name, NumberField{&value_m, "m"}}); }
  ShapeFieldLister& lengths(std::string_view name, std::vector<double>& values_m) { return add({name, LengthsField{&values_m}}); }
  ShapeFieldLister& ratio(std::string_view name, double& value) { return add({name, NumberField{&value, ""}}); }
  ShapeFieldLister& angle(std::string_view name, double& value_rad) { return add({name, AngleField{&value_rad}}); }
  ShapeFieldLister& count(std::string_view name, int& value) { return add({name, CountField{&value}}); }
  ShapeFieldLister& color(std::string_view name, std::uint32_t& rgb) { return add({name, ColorField{&rgb}}); }
  template <base::NamedEnum Enum>
  ShapeFieldLister& choice(std::string_view name, Enum& value) {
    return add({name, ChoiceField::of(value)});
  }

  [[nodiscard]] std::vector<ShapeField>& fields() { return fields_; }

 private:
  ShapeFieldLister& add(const ShapeField& field) {
    fields_.push_back(field);
    return *this;
  }

  std::vector<ShapeField> fields_;
};

template <class Shape>
[[nodiscard]] std::vector<ShapeField> listFields(Shape& shape) {
  ShapeFieldLister lister;
  shape.visit(lister);
  return std::move(lister.fields());
}

}  // namespace oikos::model
