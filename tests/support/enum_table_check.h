// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/base/enum_table.h"

namespace oikos::test {

/// Every row reads back as itself, no name or value appears twice, and the values run 0, 1, 2, … to `last`: a value that the
/// enum has and the table lacks is found.
template <base::NamedEnum Enum>
void checkEnumTable(Enum last) {
  std::set<std::string> names;
  int expected = 0;
  for (const auto& row : enumTable(Enum{})) {
    EXPECT_EQ(static_cast<int>(row.value), expected++) << row.name;
    EXPECT_FALSE(row.name.empty());
    EXPECT_TRUE(names.emplace(row.name).second) << row.name << " names two values";
    EXPECT_EQ(base::toString(row.value), row.name);
    EXPECT_EQ(base::findEnum<Enum>(row.name), row.value);
  }
  EXPECT_EQ(expected, static_cast<int>(last) + 1);
  EXPECT_FALSE(base::findEnum<Enum>("no such name"));
}

}  // namespace oikos::test
