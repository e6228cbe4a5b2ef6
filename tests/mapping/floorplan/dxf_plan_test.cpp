// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mapping/floorplan/plan_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

using base::ErrorCode;
using oikos::test::expectError;

std::string groups(std::initializer_list<std::pair<int, const char*>> list) {
  std::string text;
  for (const auto& [code, value] : list) {
    text += "  " + std::to_string(code) + "\r\n" + value + "\r\n";
  }
  return text;
}

std::string drawing(const std::string& entities, const std::string& header = "") {
  return header + groups({{0, "SECTION"}, {2, "ENTITIES"}}) + entities + groups({{0, "ENDSEC"}, {0, "EOF"}});
}

std::string units(const char* code) {
  return groups({{0, "SECTION"}, {2, "HEADER"}, {9, "$INSUNITS"}, {70, code}, {0, "ENDSEC"}});
}

std::string line(const char* layer, const char* x1, const char* y1, const char* x2, const char* y2) {
  return groups({{0, "LINE"}, {8, layer}, {10, x1}, {20, y1}, {11, x2}, {21, y2}});
}

class DxfPlan : public ::testing::Test {
 protected:
  [[nodiscard]] FloorPlan read(const std::string& text, const PlanFileOptions& options = {}) const {
    return readFloorPlan(folder_.write("plan.dxf", text), options);
  }
  void expectRefused(const std::string& text, const std::vector<std::string>& parts) const {
    expectError(ErrorCode::kInput, parts, [&] { static_cast<void>(read(text)); });
  }
  oikos::test::TemporaryFolder folder_;
};

TEST_F(DxfPlan, LinesAreReadWithTheFilesOwnUnitsUnlessToldOtherwise) {
  const std::string text = drawing(line("0", "1000", "2000", "4000", "6000"), units("4"));
  const FloorPlan millimetres = read(text);
  ASSERT_EQ(millimetres.lines.size(), 1U);
  EXPECT_LT((millimetres.lines[0].from_plan - Eigen::Vector2d(1.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((millimetres.lines[0].to_plan - Eigen::Vector2d(4.0, 6.0)).norm(), 1e-12);
  EXPECT_NEAR(read(text, {0.01, ""}).lines[0].lengthM(), 50.0, 1e-9);
  EXPECT_NEAR(read(drawing(line("0", "0", "0", "4", "0"))).lines[0].lengthM(), 4.0, 1e-12);
  EXPECT_NEAR(read(drawing(line("0", "0", "0", "10", "0"), units("2"))).lines[0].lengthM(), 3.048, 1e-12);
}

TEST_F(DxfPlan, PolylinesOfBothKindsAreReadOpenAndClosed) {
  const std::string light =
      groups({{0, "LWPOLYLINE"}, {8, "0"}, {90, "3"}, {70, "1"}, {10, "0"}, {20, "0"}, {10, "4"}, {20, "0"}, {10, "4"}, {20, "3"}});
  EXPECT_EQ(read(drawing(light)).lines.size(), 3U);
  const std::string old = groups({{0, "POLYLINE"},
                                  {8, "0"},
                                  {70, "0"},
                                  {0, "VERTEX"},
                                  {10, "0"},
                                  {20, "0"},
                                  {0, "VERTEX"},
                                  {10, "4"},
                                  {20, "0"},
                                  {0, "VERTEX"},
                                  {10, "4"},
                                  {20, "3"},
                                  {0, "SEQEND"}});
  EXPECT_EQ(read(drawing(old)).lines.size(), 2U);
}

TEST_F(DxfPlan, BulgesAndArcsLieOnTheirCircles) {
  // A half circle about (2, 0), counter-clockwise from (4, 0) to (0, 0).
  const FloorPlan bulge = read(drawing(groups({{0, "LWPOLYLINE"}, {8, "0"}, {10, "4"}, {20, "0"}, {42, "1"}, {10, "0"}, {20, "0"}})));
  EXPECT_GT(bulge.lines.size(), 10U);
  for (const PlanLine& chord : bulge.lines) {
    EXPECT_NEAR((chord.from_plan - Eigen::Vector2d(2.0, 0.0)).norm(), 2.0, 1e-9);
    EXPECT_GE(chord.to_plan.y(), -1e-9);
  }
  const FloorPlan arc = read(drawing(groups({{0, "ARC"}, {8, "0"}, {10, "1"}, {20, "1"}, {40, "2"}, {50, "270"}, {51, "90"}})));
  for (const PlanLine& chord : arc.lines) {
    EXPECT_NEAR((chord.from_plan - Eigen::Vector2d(1.0, 1.0)).norm(), 2.0, 1e-9);
    EXPECT_GE(chord.from_plan.x(), 1.0 - 1e-9);
  }
  EXPECT_GT(read(drawing(groups({{0, "CIRCLE"}, {8, "0"}, {10, "1"}, {20, "1"}, {40, "2"}}))).lines.size(), 20U);
}

TEST_F(DxfPlan, ALayerIsChosen) {
  const std::string text =
      drawing(line("WALLS", "0", "0", "4", "0") + line("FURNITURE", "0", "1", "4", "1") + groups({{0, "TEXT"}, {1, "3 m"}}));
  EXPECT_EQ(read(text).lines.size(), 2U);
  EXPECT_EQ(read(text, {1.0, "WALLS"}).lines.size(), 1U);
  expectError(ErrorCode::kInput, {"no lines on the layer \"DOORS\""}, [&] { static_cast<void>(read(text, {1.0, "DOORS"})); });
}

TEST_F(DxfPlan, OnlyEntitiesAreDrawn) {
  const std::string block = groups({{0, "SECTION"}, {2, "BLOCKS"}}) + line("0", "0", "0", "9", "0") + groups({{0, "ENDSEC"}});
  EXPECT_EQ(read(groups({{999, "a comment"}}) + drawing(line("0", "0", "0", "4", "0"), block)).lines.size(), 1U);
}

TEST_F(DxfPlan, EachMistakeIsNamedWithItsLine) {
  expectRefused(drawing(line("0", "0", "zero", "4", "0")), {"plan.dxf:12", "group 20 = \"zero\": must be a number"});
  expectRefused(drawing(groups({{0, "LINE"}, {8, "0"}, {10, "1"}, {20, "1"}, {11, "2"}})), {"plan.dxf:6", "LINE has no group 21"});
  expectRefused(drawing(groups({{0, "LWPOLYLINE"}, {10, "1"}, {10, "2"}, {20, "2"}})), {"plan.dxf:10", "a corner has no group 20"});
  expectRefused(drawing(groups({{0, "LWPOLYLINE"}, {10, "1"}, {20, "1"}, {10, "2"}})), {"plan.dxf:6", "a corner has no group 20"});
  expectRefused(drawing(groups({{0, "POLYLINE"}, {0, "VERTEX"}, {10, "0"}, {20, "0"}})), {"plan.dxf", "no SEQEND"});
  expectRefused("AutoCAD Binary DXF\r\n\x1a", {"plan.dxf:1", "binary"});
  expectRefused(groups({{0, "SECTION"}, {2, "ENTITIES"}}), {"plan.dxf:4", "ends without EOF"});
  expectRefused("  0\nSECTION\n  2", {"plan.dxf:3", "ends within a group"});
  expectRefused("walls\nand doors\n", {"plan.dxf:1", "must be a group code"});
  expectRefused(groups({{10, "1"}, {0, "EOF"}}), {"plan.dxf:2", "begins with group 10"});
  expectRefused(drawing(""), {"plan.dxf", "holds no lines"});
  expectRefused("", {"plan.dxf:0", "ends without EOF"});
}

}  // namespace
}  // namespace oikos::mapping
