// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <string>
#include <utility>
#include <vector>

namespace oikos::mapping {

/// Collects complaints of the form `section.key = value: must be …`.
class ConfigCheck {
 public:
  explicit ConfigCheck(std::string section) : section_(std::move(section)) {}

  void require(bool holds, const std::string& key, double value, const std::string& rule) {
    if (!holds) {
      char digits[32];
      const auto end = std::to_chars(digits, digits + sizeof(digits), value).ptr;
      complaints_.push_back(section_ + "." + key + " = " + std::string(digits, end) + ": " + rule);
    }
  }

  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  std::string section_;
  std::vector<std::string> complaints_;
};

}  // namespace oikos::mapping
