// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "semantic/model/pose.h"
#include "semantic/xml/validating_reader.h"

namespace oikos::semantic {

/// The attributes of one element as values. The schema has judged everything but numbers: what it refused comes as nothing, or a default.
/// Numbers are judged here, and what is wrong with them goes into `findings`.
class Attributes {
 public:
  /// Both must outlive it.
  Attributes(const XmlElement& element, std::vector<Finding>& findings) : element_(element), findings_(findings) {}

  [[nodiscard]] std::optional<std::string_view> find(std::string_view name) const;
  /// Name and value of each, in their order.
  [[nodiscard]] const std::vector<std::pair<std::string_view, std::string_view>>& all() const { return element_.attributes; }
  [[nodiscard]] std::string text(std::string_view name) const { return std::string(find(name).value_or("")); }
  [[nodiscard]] std::optional<double> number(std::string_view name) const;
  [[nodiscard]] std::optional<double> length(std::string_view name) const;  ///< not negative
  [[nodiscard]] std::optional<double> share(std::string_view name) const;   ///< from 0 to 1
  [[nodiscard]] std::optional<double> hours(std::string_view name) const;   ///< above 0, at most a century
  [[nodiscard]] std::int64_t count(std::string_view name) const;            ///< whole, from 0 to 2^53; 0 if it is not there
  [[nodiscard]] std::vector<Eigen::Vector2d> polygon(std::string_view name) const;
  [[nodiscard]] bool flag(std::string_view name) const { return find(name) == "true" || find(name) == "1"; }
  [[nodiscard]] Pose pose(std::string_view name) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> vector(std::string_view name) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> size(std::string_view name) const;  ///< none negative
  template <base::NamedEnum Enum>
  [[nodiscard]] Enum choice(std::string_view name) const {
    return base::findEnum<Enum>(find(name).value_or("")).value_or(Enum{});
  }

 private:
  /// Whether the attribute is there and is as many numbers as `values` takes.
  bool read(std::string_view name, std::span<double> values) const;
  void refuse(std::string_view name, const std::string& found, const std::string& expected) const;

  const XmlElement& element_;
  std::vector<Finding>& findings_;
};

}  // namespace oikos::semantic
