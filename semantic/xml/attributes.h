// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "semantic/model/pose.h"
#include "semantic/xml/validating_reader.h"

namespace oikos::semantic {

/// The attributes of one element as values. The schema has judged them already: what it refused comes as nothing, or a default.
class Attributes {
 public:
  explicit Attributes(const XmlElement& element) : element_(element) {}

  [[nodiscard]] std::optional<std::string_view> find(std::string_view name) const;
  [[nodiscard]] std::string text(std::string_view name) const { return std::string(find(name).value_or("")); }
  [[nodiscard]] std::optional<double> number(std::string_view name) const;
  /// All numbers of a list; empty if one of them is none.
  [[nodiscard]] std::vector<double> numbers(std::string_view name) const;
  [[nodiscard]] bool flag(std::string_view name) const { return find(name) == "true" || find(name) == "1"; }
  [[nodiscard]] Pose pose(std::string_view name) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> vector(std::string_view name) const;
  template <base::NamedEnum Enum>
  [[nodiscard]] Enum choice(std::string_view name) const {
    return base::findEnum<Enum>(find(name).value_or("")).value_or(Enum{});
  }

 private:
  const XmlElement& element_;
};

}  // namespace oikos::semantic
