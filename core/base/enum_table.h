// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace oikos::base {

/// One row of the table that names an enum's values. The table is a function beside the enum, found by its argument:
///
///     enum class Feature { kSift, kOrb };
///     constexpr auto enumTable(Feature) {
///       return std::to_array<base::EnumName<Feature>>({{Feature::kSift, "sift"}, {Feature::kOrb, "orb"}});
///     }
template <class Enum>
struct EnumName {
  Enum value;
  std::string_view name;
};

template <class T>
concept NamedEnum = std::is_enum_v<T> && requires(T value) {
  enumTable(value);
};

/// The name in files and on the command line; empty for a value that the table lacks (a bug: test the table).
template <NamedEnum Enum>
[[nodiscard]] constexpr std::string_view toString(Enum value) {
  for (const auto& row : enumTable(Enum{})) {
    if (row.value == value) {
      return row.name;
    }
  }
  return {};
}

template <NamedEnum Enum>
[[nodiscard]] constexpr std::optional<Enum> findEnum(std::string_view name) {
  for (const auto& row : enumTable(Enum{})) {
    if (row.name == name) {
      return row.value;
    }
  }
  return std::nullopt;
}

/// All names, in the table's order.
template <NamedEnum Enum>
[[nodiscard]] std::vector<std::string> enumNames() {
  std::vector<std::string> names;
  for (const auto& row : enumTable(Enum{})) {
    names.emplace_back(row.name);
  }
  return names;
}

}  // namespace oikos::base
