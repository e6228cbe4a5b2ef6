// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/base/config.h"

namespace oikos::test {

/// One field set to one value, and what `validate()` must say about it; an empty rule: nothing.
struct RuleCase {
  std::string key;
  std::string value;  ///< as TOML, and as it stands in the message
  std::string rule;
};

/// As the command line would set it; NaN, which the command line refuses, is written past it.
template <base::VisitableConfig Config>
void setField(Config& config, const std::string& key, const std::string& value) {
  if (value != "nan") {
    base::assignFields(base::listFields(config), {{}, {base::Setting{key, value, "test"}}});
    return;
  }
  for (const base::ConfigField& field : base::listFields(config)) {
    if (field.key == key) {
      *std::get<double*>(field.target) = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

/// The defaults are valid, each case draws exactly its message, and no number of the struct is without a rule.
template <base::VisitableConfig Config>
void checkConfigRules(const std::vector<RuleCase>& cases) {
  EXPECT_TRUE(base::validateConfig(Config()).empty());
  std::set<std::string> broken;
  for (const RuleCase& c : cases) {
    Config config;
    setField(config, c.key, c.value);
    const std::vector<std::string> expected =
        c.rule.empty() ? std::vector<std::string>{} : std::vector{c.key + " = " + c.value + ": " + c.rule};
    EXPECT_EQ(config.validate(), expected) << c.key << " = " << c.value;
    if (!c.rule.empty()) {
      broken.insert(c.key);
    }
  }
  Config config;
  for (const base::ConfigField& field : base::listFields(config)) {
    const bool is_number = std::holds_alternative<int*>(field.target) || std::holds_alternative<double*>(field.target);
    if (is_number && field.key.find('.') == std::string::npos) {
      EXPECT_TRUE(broken.contains(field.key)) << field.key << " has no rule, or no case here that breaks it";
    }
  }
}

}  // namespace oikos::test
