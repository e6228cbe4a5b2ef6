// SPDX-License-Identifier: Apache-2.0
// The errors of checkHome are covered by schemas/samples/invalid; here are its warnings, and what no file can say.
#include "semantic/model/home_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "semantic/model/file_check.h"
#include "tests/semantic/papers_house.h"
#include "tests/support/enum_table_check.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

void expectOnly(const std::vector<Finding>& findings, Severity severity, const std::string& element, const std::string& part) {
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].severity, severity);
  EXPECT_EQ(findings[0].element, element);
  EXPECT_NE((findings[0].found + "; " + findings[0].expected).find(part), std::string::npos)
      << findings[0].found << "; " << findings[0].expected;
}

TEST(HomeCheck, ThePapersHouseIsInOrder) {
  EXPECT_TRUE(checkHome(papersHouse()).empty());
}

TEST(HomeCheck, FurnitureOutsideItsRoom) {
  Home home = papersHouse();
  home.rooms[0].objects[0].edit().T_map_object.position_m.y() = 2.3;
  expectOnly(checkHome(home), Severity::kWarning, "object 'table'", "outside its room");
  home.rooms[0].outline_map.clear();
  EXPECT_TRUE(checkHome(home).empty());
}

TEST(HomeCheck, AnUnknownWordNamesTheNearest) {
  Home home = papersHouse();
  home.rooms[0].objects[2].edit().type = "frige";
  expectOnly(checkHome(home), Severity::kWarning, "object 'fridge'", "did you mean 'fridge'");
  home.vocabulary.edit().add(TermKind::kObjectType, {"frige", {}});
  EXPECT_TRUE(checkHome(home).empty());
}

TEST(HomeCheck, ARelationThatTheBoxesContradict) {
  Home home = papersHouse();
  SmallObject& cup = home.rooms[0].objects[0].edit().small_objects[3];
  cup.relation = Relation::kUnder;
  expectOnly(checkHome(home), Severity::kWarning, "small object 'blue-cup'", "by their boxes it is on it");
  cup.relation = Relation::kOn;
  cup.T_parent_object.position_m.x() = 0.9;
  expectOnly(checkHome(home), Severity::kWarning, "small object 'blue-cup'", "near it");
}

TEST(HomeCheck, AJointWithinARoundingOfItsLimitIsFine) {
  Home home = papersHouse();
  Joint& hinge = home.rooms[0].objects[2].edit().articulation->joints[0];
  hinge.value = hinge.upper + 1e-12;
  EXPECT_TRUE(checkHome(home).empty());
}

TEST(HomeCheck, FilesThatAreMissing) {
  const test::TemporaryFolder folder;
  (void)folder.write("models/table.obj", "o table\n");
  Home home = papersHouse();
  home.rooms[0].objects[0].edit().model = "models/table.obj";
  EXPECT_TRUE(checkFiles(home, folder.path()).empty());
  home.rooms[0].objects[0].edit().small_objects[3].model = "models/cup.obj";
  expectOnly(checkFiles(home, folder.path()), Severity::kWarning, "small object 'blue-cup'", "'models/cup.obj', which is missing");
}

TEST(HomeCheck, EnumTables) {
  test::checkEnumTable(Relation::kUnder);
  test::checkEnumTable(Movability::kMovable);
  test::checkEnumTable(JointType::kPrismatic);
  test::checkEnumTable(SwitchKind::kPrismatic);
  test::checkEnumTable(HandleKind::kRecessed);
  test::checkEnumTable(TermKind::kSurplus);
}

}  // namespace
}  // namespace oikos::semantic
