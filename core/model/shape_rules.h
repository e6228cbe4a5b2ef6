// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/config_rules.h"
#include "core/base/degrees.h"

namespace oikos::model {

/// base::ConfigRules with the words of a shape's fields.
class ShapeRules {
 public:
  explicit ShapeRules(std::string_view owner) : prefix_(std::string(owner) + ".") {}

  /// Longer than nothing and no longer than a hall.
  ShapeRules& length(std::string_view name, double value_m) {
    rules_.greater(prefix_ + std::string(name), value_m, 0.0);
    if (value_m > kMaxLength_m) {
      rules_.between(prefix_ + std::string(name), value_m, 0.0, kMaxLength_m);
    }
    return *this;
  }
  template <class Number>
  ShapeRules& between(std::string_view name, Number value, std::type_identity_t<Number> low, std::type_identity_t<Number> high) {
    rules_.between(prefix_ + std::string(name), value, low, high);
    return *this;
  }
  template <class Number>
  ShapeRules& require(bool kept, std::string_view name, Number value, std::string_view rule) {
    rules_.require(kept, prefix_ + std::string(name), value, rule);
    return *this;
  }
  /// `name_deg` is the name that files give it; so are the limits.
  ShapeRules& angle(std::string_view name_deg, double value_rad, double low_deg, double high_deg) {
    rules_.between(prefix_ + std::string(name_deg), base::toDegrees(value_rad), low_deg, high_deg);
    return *this;
  }
  ShapeRules& color(std::string_view name, std::uint32_t rgb) {
    rules_.require(rgb <= 0xFFFFFFU, prefix_ + std::string(name), rgb, "must be 0xRRGGBB, at most 16777215");
    return *this;
  }

  [[nodiscard]] const std::vector<std::string>& messages() const { return rules_.messages(); }

 private:
  static constexpr double kMaxLength_m = 100.0;
  std::string prefix_;
  base::ConfigRules rules_;
};

}  // namespace oikos::model
