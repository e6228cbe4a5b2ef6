// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/number_text.h"

namespace oikos::base {

/// Gathers what is wrong with a configuration, in the form `name = value: must be > 0`. NaN breaks every rule.
class ConfigRules {
 public:
  template <class Number>
  ConfigRules& greater(std::string_view name, Number value, std::type_identity_t<Number> bound) {
    return require(value > bound, name, value, "must be > " + text(bound));
  }
  template <class Number>
  ConfigRules& atLeast(std::string_view name, Number value, std::type_identity_t<Number> bound) {
    return require(value >= bound, name, value, "must be >= " + text(bound));
  }
  template <class Number>
  ConfigRules& between(std::string_view name, Number value, std::type_identity_t<Number> low, std::type_identity_t<Number> high) {
    return require(value >= low && value <= high, name, value, "must be from " + text(low) + " to " + text(high));
  }
  /// Any other rule, in the words of `rule`: "must be a multiple of 4". The value may also be one of a named enum.
  template <class Value>
  ConfigRules& require(bool kept, std::string_view name, Value value, std::string_view rule) {
    if (!kept) {
      messages_.push_back(std::string(name) + " = " + text(value) + ": " + std::string(rule));
    }
    return *this;
  }

  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  template <class Value>
  static std::string text(Value value) {
    static_assert(std::is_arithmetic_v<Value> || NamedEnum<Value>);
    if constexpr (NamedEnum<Value>) {
      return std::string(toString(value));
    } else if constexpr (std::is_floating_point_v<Value>) {
      return toText(static_cast<double>(value));
    } else {
      return toText(static_cast<std::int64_t>(value));
    }
  }

  std::vector<std::string> messages_;
};

}  // namespace oikos::base
