// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/statement.h"

#include <gtest/gtest.h>

#include "semantic/xml/home_reader.h"

namespace oikos::semantic {
namespace {

class Statement : public testing::Test {
 protected:
  [[nodiscard]] Placement placementIn(const std::string& statement, const std::string& subject) const {
    const StatementReading reading = readStatement(index_, statement);
    EXPECT_TRUE(reading.correction) << statement << ": " << reading.sentence;
    if (!reading.correction) {
      return {};
    }
    EXPECT_EQ(reading.correction->subject, subject) << statement;
    const auto* placement = std::get_if<Placement>(&reading.correction->after);
    return placement == nullptr ? Placement{} : *placement;
  }

  HomeIndex index_{readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml").home};
};

TEST_F(Statement, AThingIsInARoom) {
  const Placement placement = placementIn("the blue cup is in the bathroom", "blue-cup");
  EXPECT_EQ(placement.parent, "bathroom");
  EXPECT_EQ(placement.relation, Relation::kOn);
  EXPECT_LT((placement.T_parent_object.position_m - Eigen::Vector3d(0.75, 3.25, 0.0)).norm(), 1e-12) << "the middle of its outline";
}

TEST_F(Statement, AThingIsInFurniture) {
  const Placement placement = placementIn("I put the red mug in the cabinet", "red-cup");
  EXPECT_EQ(placement.parent, "cupboard");
  EXPECT_EQ(placement.relation, Relation::kIn);
  const Placement on_table = placementIn("the bowl is now on the kitchen table", "bowl");
  EXPECT_EQ(on_table.parent, "table");
  EXPECT_LT((on_table.T_parent_object.position_m - Eigen::Vector3d(0.0, 0.0, 0.75)).norm(), 1e-12) << "the table's top";
}

TEST_F(Statement, StatesOfFurniture) {
  const StatementReading off = readStatement(index_, "the thermostat is off");
  ASSERT_TRUE(off.correction) << off.sentence;
  EXPECT_EQ(off.correction->subject, "fridge-thermostat");
  EXPECT_EQ(std::get<KnobSetting>(off.correction->after).state, "off");
  const StatementReading closed = readStatement(index_, "the fridge is closed");
  ASSERT_TRUE(closed.correction) << closed.sentence;
  EXPECT_EQ(closed.correction->subject, "fridge-hinge");
  EXPECT_EQ(std::get<JointValue>(closed.correction->after).value, 0.0);
}

TEST_F(Statement, WhatIsNotOneThingIsRefused) {
  for (const char* statement : {"the cup is in the bathroom", "the ukulele is in the bathroom", "the blue cup is in the ukulele", "dance",
                                "", "the table is in the bathroom", "the blue cup is", "is the blue cup in the bathroom"}) {
    const StatementReading reading = readStatement(index_, statement);
    EXPECT_FALSE(reading.correction) << statement;
    EXPECT_FALSE(reading.sentence.empty()) << statement;
  }
}

}  // namespace
}  // namespace oikos::semantic
