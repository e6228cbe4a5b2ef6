// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/attributes.h"

#include "core/base/number_text.h"

namespace oikos::semantic {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

}  // namespace

std::optional<std::string_view> Attributes::find(std::string_view name) const {
  for (const auto& [key, value] : element_.attributes) {
    if (key == name) {
      return value;
    }
  }
  return std::nullopt;
}

std::optional<double> Attributes::number(std::string_view name) const {
  const std::vector<double> all = numbers(name);
  return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
}

std::vector<double> Attributes::numbers(std::string_view name) const {
  std::vector<double> all;
  std::string_view rest = find(name).value_or("");
  for (auto begin = rest.find_first_not_of(kSpace); begin != std::string_view::npos; begin = rest.find_first_not_of(kSpace)) {
    rest.remove_prefix(begin);
    const std::string_view word = rest.substr(0, rest.find_first_of(kSpace));
    const auto value = base::findNumber(word.starts_with('+') ? word.substr(1) : word);
    if (!value) {
      return {};
    }
    all.push_back(*value);
    rest.remove_prefix(word.size());
  }
  return all;
}

Pose Attributes::pose(std::string_view name) const {
  const std::vector<double> n = numbers(name);
  if (n.size() != 6) {
    return {};
  }
  return {{n[0], n[1], n[2]}, Eigen::Vector3d(n[3], n[4], n[5]) * kRadPerDeg};
}

std::optional<Eigen::Vector3d> Attributes::vector(std::string_view name) const {
  const std::vector<double> n = numbers(name);
  return n.size() == 3 ? std::optional(Eigen::Vector3d(n[0], n[1], n[2])) : std::nullopt;
}

}  // namespace oikos::semantic
