// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace oikos::semantic {

enum class Severity { kWarning, kError };

/// One thing that is wrong with a home, said so that a person can mend it.
struct Finding {
  Severity severity = Severity::kError;
  int line = 0;         ///< of home.xml; 0: of no single line
  std::string element;  ///< for instance "joint 'left-hinge'"
  std::string found;
  std::string expected;  ///< empty where `found` says it all
  bool operator==(const Finding&) const = default;
};

[[nodiscard]] inline bool hasErrors(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Severity::kError; });
}

}  // namespace oikos::semantic
