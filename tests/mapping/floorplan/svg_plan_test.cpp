// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "mapping/floorplan/plan_file.h"
#include "mapping/floorplan/plan_readers.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

using base::ErrorCode;
using oikos::test::expectError;

class SvgPlan : public ::testing::Test {
 protected:
  [[nodiscard]] FloorPlan read(const std::string& inside, const PlanFileOptions& options = {}) const {
    return readFloorPlan(folder_.write("plan.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\">\n" + inside + "\n</svg>\n"), options);
  }
  void expectRefused(const std::string& inside, const std::vector<std::string>& parts) const {
    expectError(ErrorCode::kInput, parts, [&] { static_cast<void>(read(inside)); });
  }
  oikos::test::TemporaryFolder folder_;
};

void expectLine(const PlanLine& line, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  EXPECT_LT((line.from_plan - from).norm(), 1e-9) << line.from_plan.transpose();
  EXPECT_LT((line.to_plan - to).norm(), 1e-9) << line.to_plan.transpose();
}

// In SVG y points down; a plan that were not turned over would be mirrored.
TEST_F(SvgPlan, YPointsUpAndUnitsBecomeMetres) {
  const FloorPlan plan = read("<line x1=\"100\" y1=\"200\" x2=\"400\" y2=\"600\"/>", {0.01, ""});
  ASSERT_EQ(plan.lines.size(), 1U);
  expectLine(plan.lines[0], {1.0, -2.0}, {4.0, -6.0});
}

TEST_F(SvgPlan, EveryShapeIsRead) {
  EXPECT_EQ(read("<rect x=\"1\" y=\"1\" width=\"4px\" height=\"3\"/>").lines.size(), 4U);
  EXPECT_EQ(read("<polyline points=\"0,0 4,0 4,3\"/>").lines.size(), 2U);
  EXPECT_EQ(read("<polygon points=\"0 0 4 0 4 3\"/>").lines.size(), 3U);
  EXPECT_EQ(read("<path d=\"M0 0h4v3H0z\"/>").lines.size(), 4U);
  const FloorPlan circle = read("<circle cx=\"1\" cy=\"2\" r=\"3\"/>");
  EXPECT_GT(circle.lines.size(), 20U);
  for (const PlanLine& line : circle.lines) {
    EXPECT_NEAR((line.from_plan - Eigen::Vector2d(1.0, -2.0)).norm(), 3.0, 1e-9);
  }
  EXPECT_GT(read("<ellipse cx=\"1\" cy=\"2\" rx=\"3\" ry=\"1\"/>").lines.size(), 20U);
}

TEST_F(SvgPlan, TransformsApplyFromTheInnermostOutwards) {
  const FloorPlan plan =
      read("<g transform=\"translate(10, 0) rotate(90)\"><line x1=\"1\" y1=\"0\" x2=\"3\" y2=\"0\" transform=\"scale(2)\"/></g>");
  ASSERT_EQ(plan.lines.size(), 1U);
  expectLine(plan.lines[0], {10.0, -2.0}, {10.0, -6.0});
}

TEST(SvgTransform, EachKindMovesAPointAsTheStandardSays) {
  const std::filesystem::path file = "plan.svg";
  const PlanSource source{file, 1};
  const Eigen::Vector2d p(1.0, 2.0);
  const auto at = [&](const std::string& text) { return Eigen::Vector2d(parseSvgTransform(text, source) * p); };
  EXPECT_LT((at("matrix(1 2 3 4 5 6)") - Eigen::Vector2d(12.0, 16.0)).norm(), 1e-12);
  EXPECT_LT((at("translate(3)") - Eigen::Vector2d(4.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((at("scale(2,-1)") - Eigen::Vector2d(2.0, -2.0)).norm(), 1e-12);
  EXPECT_LT((at("rotate(90 1 1)") - Eigen::Vector2d(0.0, 1.0)).norm(), 1e-12);
  EXPECT_LT((at("skewX(45)") - Eigen::Vector2d(3.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((at("skewY(45)") - Eigen::Vector2d(1.0, 3.0)).norm(), 1e-12);
}

TEST(SvgPath, RelativeAbsoluteAndRepeatedCommands) {
  const std::filesystem::path file = "plan.svg";
  const std::vector<Polyline> lines = parseSvgPath("m1,1 2-1 l.5.5M0 0L1e1 0zl1 1", {file, 1});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], (Polyline{{1.0, 1.0}, {3.0, 0.0}, {3.5, 0.5}}));
  EXPECT_EQ(lines[1], (Polyline{{0.0, 0.0}, {10.0, 0.0}, {0.0, 0.0}}));
  EXPECT_EQ(lines[2], (Polyline{{0.0, 0.0}, {1.0, 1.0}})) << "after z a path goes on from its start";
}

TEST(SvgPath, CurvesEndWhereTheyShouldAndPassTheirMiddle) {
  const std::filesystem::path file = "plan.svg";
  const auto curve = [&](const std::string& d) { return parseSvgPath(d, {file, 1}).at(0); };
  const Polyline cubic = curve("M0 0C0 1 1 1 1 0");
  EXPECT_LT((cubic[cubic.size() / 2] - Eigen::Vector2d(0.5, 0.75)).norm(), 1e-9);
  const Polyline quadratic = curve("M0 0Q1 2 2 0");
  EXPECT_LT((quadratic[quadratic.size() / 2] - Eigen::Vector2d(1.0, 1.0)).norm(), 1e-9);
  EXPECT_LT((curve("M0 0C0 1 1 1 1 0S2 -1 2 0").back() - Eigen::Vector2d(2.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((curve("M0 0Q1 2 2 0T4 0").at(24) - Eigen::Vector2d(3.0, -1.0)).norm(), 1e-9) << "mirrored";
}

TEST(SvgPath, ArcsLieOnTheirCircle) {
  const std::filesystem::path file = "plan.svg";
  const std::vector<std::pair<std::string, Eigen::Vector2d>> arcs = {{"M1 0A1 1 0 0 1 0 1", {0.0, 0.0}},
                                                                     {"M1 0A1 1 0 0 0 0 1", {1.0, 1.0}},
                                                                     {"M1 0A1 1 0 1 1 0 1", {1.0, 1.0}},
                                                                     {"M1 0A1 1 0 1 0 0 1", {0.0, 0.0}}};
  for (const auto& [d, centre] : arcs) {
    const Polyline arc = parseSvgPath(d, {file, 1}).at(0);
    EXPECT_GT(arc.size(), d.find(" 1 1 0 1 ") != std::string::npos ? 20U : 7U) << d;
    for (const Eigen::Vector2d& p : arc) {
      EXPECT_NEAR((p - centre).norm(), 1.0, 1e-9) << d;
    }
    EXPECT_EQ(arc.back(), Eigen::Vector2d(0.0, 1.0));
  }
  // Radii that do not reach are enlarged.
  EXPECT_NEAR((parseSvgPath("M-2 0A1 1 0 0 1 2 0", {file, 1}).at(0).at(4)).norm(), 2.0, 1e-9);
}

TEST_F(SvgPlan, ALayerIsChosenByIdOrLabel) {
  const std::string drawing =
      "<g id=\"walls\"><line x2=\"4\"/></g>\n<g xmlns:inkscape=\"i\" inkscape:label=\"Furniture\"><line y2=\"5\"/><use href=\"#x\"/></g>";
  EXPECT_EQ(read(drawing, {1.0, "walls"}).lines.size(), 1U);
  expectError(ErrorCode::kInput, {"plan.svg", "no lines on the layer \"doors\""}, [&] {
    static_cast<void>(read(drawing, {1.0, "doors"}));
  });
  expectError(ErrorCode::kInput, {"plan.svg:3", "use: is not read"}, [&] { static_cast<void>(read(drawing, {1.0, "Furniture"})); });
}

TEST_F(SvgPlan, WhatIsNotDrawnIsNotRead) {
  EXPECT_EQ(read("<line x2=\"4\"/><defs><line x2=\"9\"/></defs><text>3 m</text><line x2=\"7\" display=\"none\"/>"
                 "<g style=\"display:none\"><line x2=\"8\"/></g><symbol><line x2=\"6\"/></symbol>")
                .lines.size(),
            1U);
}

TEST_F(SvgPlan, EachMistakeIsNamedWithItsLine) {
  expectRefused("\n<line x1=\"1 m\" x2=\"4\"/>", {"plan.svg:3", "x1 = \"1 m\"", "number of user units"});
  expectRefused("<line x1=\"nan\" x2=\"4\"/>", {"plan.svg:2", "x1"});
  expectRefused("<polyline points=\"0 0 4\"/>", {"plan.svg:2", "3 numbers; must be pairs"});
  expectRefused("<polyline points=\"0 0 4 x\"/>", {"plan.svg:2", "\"x\": must be a number"});
  expectRefused("<rect width=\"-4\" height=\"3\"/>", {"plan.svg:2", "must not be negative"});
  expectRefused("<path d=\"L1 1\"/>", {"plan.svg:2", "must begin with M"});
  expectRefused("<path d=\"M0 0L1\"/>", {"plan.svg:2", "its end where a number of L is expected"});
  expectRefused("<path d=\"M0 0B1 1\"/>", {"plan.svg:2", "there is no command \"B\""});
  expectRefused("<path d=\"M0 0z 1 1\"/>", {"plan.svg:2", "where a command is expected"});
  expectRefused("<path d=\"M0 0A1 1 0 2 0 1 1\"/>", {"plan.svg:2", "a flag of A must be 0 or 1"});
  expectRefused("<g transform=\"turn(3)\"><line x2=\"4\"/></g>", {"plan.svg:2", "\"turn\" with 1 numbers"});
  expectRefused("<g transform=\"scale 3\"><line x2=\"4\"/></g>", {"plan.svg:2", "must be NAME(NUMBERS)"});
  expectRefused("<svg><line x2=\"4\"/></svg>", {"plan.svg:2", "a drawing within the drawing"});
  expectRefused("<image href=\"scan.png\"/>", {"plan.svg:2", "image: is not read"});
  expectRefused("<line x2=\"4\"></g>", {"plan.svg:2", "mismatch"});
  expectRefused("<text>no walls</text>", {"plan.svg", "holds no lines"});
}

TEST_F(SvgPlan, ASizeThatNoHomeHasIsRefusedWithTheScale) {
  expectRefused("<line x2=\"4000\"/>", {"4000 m wide at 1 metres a unit", "1 to 300 m"});
  expectError(ErrorCode::kInput, {"0.4 m wide at 0.1 metres"}, [&] { static_cast<void>(read("<line x2=\"4\"/>", {0.1, ""})); });
}

TEST_F(SvgPlan, WhatIsNoPlanIsRefused) {
  const auto expectFile = [&](ErrorCode code, const std::string& name, const std::string& text, const std::vector<std::string>& parts) {
    expectError(code, parts, [&] { static_cast<void>(readFloorPlan(folder_.write(name, text), {})); });
  };
  expectFile(ErrorCode::kUsage, "plan.pdf", "%PDF", {"plan.pdf", ".svg or .dxf"});
  expectFile(ErrorCode::kInput, "a.svg", "", {"a.svg:"});
  expectFile(ErrorCode::kInput, "b.svg", "<html/>", {"b.svg:1", "root element must be svg"});
  expectFile(ErrorCode::kInput, "c.svg", "<!DOCTYPE svg [<!ENTITY a \"b\">]>\n<svg><line x2=\"4\"/></svg>", {"c.svg:1", "entities"});
  expectError(ErrorCode::kIo, {"none.svg"}, [&] { static_cast<void>(readFloorPlan(folder_.path() / "none.svg", {})); });
}

TEST_F(SvgPlan, LinesThatTouchAreOneRoom) {
  const FloorPlan plan = read("<polygon points=\"0 0 4 0 4 3\"/><line x1=\"4\" y1=\"3\" x2=\"9\" y2=\"3\"/><line x1=\"20\" x2=\"24\"/>");
  ASSERT_EQ(plan.lines.size(), 5U);
  EXPECT_EQ(plan.lines[0].room, plan.lines[3].room);
  EXPECT_NE(plan.lines[0].room, plan.lines[4].room);
}

}  // namespace
}  // namespace oikos::mapping
