// SPDX-License-Identifier: Apache-2.0
#include "core/model/shapes/shape_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <optional>
#include <set>
#include <string>

#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/model/furniture/cabinet.h"
#include "core/model/furniture/living.h"
#include "core/model/small_objects.h"

namespace oikos::model {
namespace {

std::string failureOf(const std::string& kind, const Dimensions& dimensions) {
  try {
    (void)makeShape(kind, dimensions, "home.xml:7");
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kInput);
    return error.what();
  }
  return "none";
}

bool isSame(const TriangleMesh& a, const TriangleMesh& b) {
  const auto same_material = [](const Material& m, const Material& n) { return m.name == n.name && m.color_rgb == n.color_rgb; };
  return a.vertices == b.vertices && a.triangles == b.triangles && a.triangle_materials == b.triangle_materials &&
         std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(), same_material);
}

bool isSame(const ArticulatedModel& a, const ArticulatedModel& b) {
  const auto part = [](const ModelPart& p, const ModelPart& q) { return p.name == q.name && isSame(*p.mesh_part, *q.mesh_part); };
  const auto joint = [](const ModelJoint& j, const ModelJoint& k) {
    return j.name == k.name && j.type == k.type && j.T_parent_joint.matrix() == k.T_parent_joint.matrix() && j.axis_joint == k.axis_joint &&
           j.lower == k.lower && j.upper == k.upper;
  };
  const auto handle = [](const ModelHandle& h, const ModelHandle& i) {
    return h.name == i.name && h.T_part_handle.matrix() == i.T_part_handle.matrix() && h.length_m == i.length_m && h.kind == i.kind;
  };
  const auto state = [](const ModelKnobState& s, const ModelKnobState& t) { return s.name == t.name && s.angle_rad == t.angle_rad; };
  const auto knob = [&](const ModelKnob& k, const ModelKnob& l) {
    return k.name == l.name && std::equal(k.states.begin(), k.states.end(), l.states.begin(), l.states.end(), state);
  };
  return a.name == b.name && std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), part) &&
         std::equal(a.joints.begin(), a.joints.end(), b.joints.begin(), b.joints.end(), joint) &&
         std::equal(a.handles.begin(), a.handles.end(), b.handles.begin(), b.handles.end(), handle) &&
         std::equal(a.knobs.begin(), a.knobs.end(), b.knobs.begin(), b.knobs.end(), knob);
}

class EachKind : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(ShapeText, EachKind, testing::ValuesIn(shapeKinds()), [](const auto& p) { return p.param; });

TEST_P(EachKind, ItsDefaultsAsTextAreItsDefaults) {
  const ArticulatedModel model = makeShape(GetParam(), {}, "here");
  EXPECT_EQ(model.name, GetParam());
  EXPECT_FALSE(model.parts.front().mesh_part->empty());
  EXPECT_EQ(model.parts.front().name, "body");
  const Dimensions all = shapeDimensions(GetParam());
  EXPECT_GE(all.size(), 4U);
  EXPECT_TRUE(validateShape(GetParam(), all).empty());
  EXPECT_TRUE(isSame(makeShape(GetParam(), all, "here"), model));
}

/// The text of a value that is a little different; nothing for a choice, which has no neighbours.
std::optional<std::string> changed(const std::string& name, const std::string& value) {
  if (name.ends_with("_rgb")) {
    return value == "#123456" ? "#654321" : "#123456";
  }
  const auto number = base::findNumber(value);
  if (!number) {
    return std::nullopt;
  }
  return base::toText(name.ends_with("_count") ? *number + 1.0 : name.ends_with("_deg") ? *number - 1.0 : *number + 0.002);
}

/// What is of no consequence as long as something else is not there, and how to have it: a worktop's overhang.
Dimensions withWhatItNeeds(const std::string& kind, const std::string& name) {
  if (kind != "counter" && name.starts_with("worktop_")) {
    return {{"worktop_thickness_m", "0.03"}};
  }
  return {};
}

TEST_P(EachKind, EachDimensionChangesItOrBreaksARule) {
  for (const auto& [name, value] : shapeDimensions(GetParam())) {
    const auto other = changed(name, value);
    if (!other) {
      continue;
    }
    Dimensions before = withWhatItNeeds(GetParam(), name);
    std::erase_if(before, [&name = name](const auto& dimension) { return dimension.first == name; });
    Dimensions after = before;
    after.emplace_back(name, *other);
    if (const auto faults = validateShape(GetParam(), after); !faults.empty()) {
      EXPECT_TRUE(faults.front().find("must") != std::string::npos) << faults.front();
      continue;
    }
    EXPECT_FALSE(isSame(makeShape(GetParam(), after, "here"), makeShape(GetParam(), before, "here"))) << name << " = " << *other;
  }
}

TEST_P(EachKind, NamesSayTheUnit) {
  std::set<std::string> names;
  for (const auto& [name, value] : shapeDimensions(GetParam())) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_FALSE(name.ends_with("_rad")) << name;
    EXPECT_EQ(name.ends_with("_rgb"), value.starts_with("#")) << name;
  }
}

TEST(ShapeText, EachKindOfFieldIsRead) {
  const ArticulatedModel read = makeShape("cabinet",
                                          {{"width_m", "0.8"},
                                           {"door_count", "2"},
                                           {"handle", "bar_horizontal"},
                                           {"handle_level", "0.5"},
                                           {"door_opening_deg", "95"},
                                           {"front_rgb", "#0a0B0c"}},
                                          "here");
  const CabinetShape meant = {.width_m = 0.8,
                              .door_count = 2,
                              .door_opening_rad = 95.0 * base::kRadPerDeg,
                              .handle = HandleStyle::kBarHorizontal,
                              .handle_level = 0.5,
                              .front_rgb = 0x0A0B0C};
  EXPECT_TRUE(isSame(read, makeCabinet(meant)));
  EXPECT_EQ(read.joints.size(), 2U);
  EXPECT_TRUE(isSame(makeShape("drawer_unit", {{"drawer_count", "2"}, {"front_heights_m", " 0.2  0.4 "}}, "here"),
                     makeDrawerUnit({.drawer_count = 2, .front_heights_m = {0.2, 0.4}})));
}

TEST(ShapeText, SmallObjectsAreOnePart) {
  const ArticulatedModel cup = makeShape("cup", {{"height_m", "0.12"}}, "here");
  ASSERT_EQ(cup.parts.size(), 1U);
  EXPECT_TRUE(isSame(*cup.parts[0].mesh_part, makeCup({.height_m = 0.12})));
  EXPECT_NEAR(cup.parts[0].mesh_part->bounds().max().z(), 0.12, 1e-7);
}

TEST(ShapeText, NamesTheNearestKindAndDimension) {
  EXPECT_EQ(failureOf("cabnet", {}), "home.xml:7: no shape of kind 'cabnet'; did you mean 'cabinet'?");
  EXPECT_EQ(failureOf("rug", {{"widht_m", "1"}}), "home.xml:7: 'rug' has no dimension 'widht_m'; did you mean 'width_m'?");
  EXPECT_EQ(failureOf("rug", {{"color", "1"}}),
            "home.xml:7: 'rug' has no dimension 'color'; known: width_m, depth_m, height_m, border_m, middle_rgb, border_rgb");
}

TEST(ShapeText, SaysWhatAValueMustBe) {
  EXPECT_EQ(failureOf("rug", {{"width_m", "1"}, {"width_m", "1"}}), "home.xml:7: width_m is given twice");
  for (const char* wrong : {"", "wide", "1,5", "1 m", " 1", "nan", "inf", "1e999"}) {
    EXPECT_EQ(failureOf("rug", {{"width_m", wrong}}), "home.xml:7: width_m = '" + std::string(wrong) + "': must be a number (m)");
  }
  EXPECT_EQ(failureOf("cabinet", {{"handle_level", "up"}}), "home.xml:7: handle_level = 'up': must be a number");
  for (const char* wrong : {"", "two", "1.5", "99999999999", "0x2"}) {
    EXPECT_EQ(failureOf("sofa", {{"seat_count", wrong}}), "home.xml:7: seat_count = '" + std::string(wrong) + "': must be a whole number");
  }
  for (const char* wrong : {"", "red", "#fff", "#12345G", "#1234567", "0x123456", "#-12345"}) {
    EXPECT_EQ(failureOf("rug", {{"border_rgb", wrong}}),
              "home.xml:7: border_rgb = '" + std::string(wrong) + "': must be a colour as #D8CBB2");
  }
  EXPECT_EQ(failureOf("cabinet", {{"hinge", "Left"}}), "home.xml:7: hinge = 'Left': must be left, right, top or bottom");
  EXPECT_EQ(failureOf("cabinet", {{"door_opening_deg", "wide"}}), "home.xml:7: door_opening_deg = 'wide': must be a number (degrees)");
  EXPECT_EQ(failureOf("drawer_unit", {{"front_heights_m", "0.2;0.3"}}),
            "home.xml:7: front_heights_m = '0.2;0.3': must be numbers (m) with spaces between them");
}

TEST(ShapeText, BrokenRulesAreSaidInTheUnitsOfTheFile) {
  EXPECT_EQ(failureOf("cabinet", {{"door_count", "3"}}), "home.xml:7: door_count = 3: must be from 0 to 2");
  EXPECT_EQ(failureOf("cabinet", {{"door_opening_deg", "200"}}), "home.xml:7: door_opening_deg = 200: must be from 5 to 183");
  EXPECT_EQ(failureOf("fridge", {{"hinge", "top"}}), "home.xml:7: hinge = top: must be left or right");
  EXPECT_EQ(failureOf("cup", {{"wall_m", "0.05"}}), "home.xml:7: wall_m = 0.05: must leave room inside");
  EXPECT_EQ(validateShape("rug", {{"width_m", "wide"}, {"depth", "2"}}).size(), 2U);
}

TEST(ShapeText, DimensionsOfAnUnknownKind) {
  EXPECT_THROW((void)shapeDimensions("cubboard"), base::Error);
  EXPECT_EQ(shapeDimensions("cabinet").front(), (std::pair<std::string, std::string>("width_m", "0.6")));
  const Dimensions cabinet = shapeDimensions("cabinet");
  EXPECT_NE(std::find(cabinet.begin(), cabinet.end(), std::pair<std::string, std::string>("door_opening_deg", "110")), cabinet.end());
}

TEST(ShapeText, ReadsAndWritesTheSameInEveryLocale) {
  const Dimensions before = shapeDimensions("cabinet");
  const char* const set = std::setlocale(LC_ALL, "de_DE.UTF-8");
  if (set == nullptr) {
    GTEST_SKIP() << "no German locale on this machine";
  }
  EXPECT_EQ(shapeDimensions("cabinet"), before);
  EXPECT_EQ(makeShape("rug", {{"height_m", "0.5"}}, "here").parts[0].mesh_part->bounds().max().z(), 0.5F);
  std::setlocale(LC_ALL, "C");
}

}  // namespace
}  // namespace oikos::model
