// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/home_reader.h"

#include <gtest/gtest.h>

#include <string>

#include "core/base/read_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

using base::ErrorCode;
using test::expectError;

constexpr double kPi = 3.14159265358979323846;

const Home& papersHouse() {
  static const Home home = readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml").home;
  return home;
}

class HomeReader : public testing::Test {
 protected:
  [[nodiscard]] HomeReading read(std::string_view content) const { return readHome(folder_.write("home.xml", content)); }
  test::TemporaryFolder folder_;
};

TEST(PapersHouse, HasItsRoomsAndFurniture) {
  const Home& home = papersHouse();
  ASSERT_EQ(home.rooms.size(), 2U);
  EXPECT_EQ(home.rooms[0].id.value, "kitchen");
  EXPECT_EQ(home.rooms[1].type, "bathroom");
  EXPECT_EQ(home.rooms[0].outline_map.size(), 4U);
  EXPECT_EQ(home.time_zone, "Europe/Rome");
  const auto& furniture = home.rooms[0].objects;
  ASSERT_EQ(furniture.size(), 3U);
  EXPECT_EQ(furniture[0]->label, "kitchen table");
  EXPECT_EQ(furniture[0]->movability, Movability::kShiftable);
  EXPECT_EQ(furniture[0]->parking_poses.size(), 3U);
  EXPECT_FALSE(furniture[0]->articulation);
  EXPECT_NEAR(furniture[1]->T_map_object.roll_pitch_yaw_rad.z(), kPi, 1e-12);
}

TEST(PapersHouse, HasTheCups) {
  const LargeObject& table = papersHouse().rooms[0].objects[0];
  ASSERT_EQ(table.small_objects.size(), 4U);
  const SmallObject& cup = table.small_objects[3];
  EXPECT_EQ(cup.id.value, "blue-cup");
  EXPECT_EQ(cup.type, "cup");
  EXPECT_EQ(cup.parent, "table");
  EXPECT_EQ(cup.relation, Relation::kOn);
  ASSERT_EQ(cup.properties.size(), 1U);
  EXPECT_EQ(cup.properties[0], (Property{"color", "blue"}));
  ASSERT_EQ(cup.default_places.size(), 2U);
  EXPECT_EQ(cup.default_places[1].parent, "cupboard-body");
  EXPECT_EQ(cup.default_places[1].relation, Relation::kIn);
  EXPECT_TRUE(cup.graspable);
  EXPECT_EQ(cup.grasping_points.size(), 1U);
  ASSERT_TRUE(cup.box_model);
  EXPECT_EQ(cup.box_model->size_m, Eigen::Vector3d(0.08, 0.11, 0.1));
  EXPECT_FALSE(cup.last_seen_ns);
}

TEST(PapersHouse, HasItsDoorsAndKnob) {
  const Articulation& fridge = *papersHouse().rooms[0].objects[2]->articulation;
  ASSERT_EQ(fridge.joints.size(), 1U);
  EXPECT_EQ(fridge.joints[0].type, JointType::kRevolute);
  EXPECT_NEAR(fridge.joints[0].upper, 120.0 * kPi / 180.0, 1e-12);
  ASSERT_EQ(fridge.handles.size(), 1U);
  EXPECT_EQ(fridge.handles[0].length_m, 0.3);
  ASSERT_EQ(fridge.knobs.size(), 1U);
  EXPECT_EQ(fridge.knobs[0].states.size(), 5U);
  EXPECT_EQ(fridge.knobs[0].current, "3");
  EXPECT_NEAR(fridge.knobs[0].states[3].angle_rad, kPi, 1e-12);
}

TEST(PapersHouse, EveryElementKnowsItsLine) {
  const std::string content = base::readFile(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml");
  const int line = papersHouse().rooms[0].objects[0]->small_objects[3].line.number;
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) {
    begin = content.find('\n', begin) + 1;
  }
  EXPECT_NE(content.substr(begin, content.find('\n', begin) - begin).find("blue-cup"), std::string::npos) << line;
}

TEST_F(HomeReader, AFileThatIsNotThereIsAnError) {
  expectError(ErrorCode::kIo, {"nowhere.xml"}, [&] { (void)readHome(folder_.path() / "nowhere.xml"); });
  expectError(ErrorCode::kIo, {folder_.path().string()}, [&] { (void)readHome(folder_.path()); });
}

TEST_F(HomeReader, WhatIsNoXmlHasOneSetOfFindingsAndNoHome) {
  for (const std::string_view content : {"", "   ", "hello", "<", "<apartment", "\xFF\xFE\x01", "\x89PNG\r\n"}) {
    const HomeReading reading = read(content);
    EXPECT_FALSE(reading.complete) << content;
    EXPECT_TRUE(hasErrors(reading.findings)) << content;
  }
}

TEST_F(HomeReader, EntitiesAreNeverExpanded) {
  std::string bomb = "<?xml version=\"1.0\"?><!DOCTYPE l [<!ENTITY l0 \"lol\">";
  for (int i = 1; i < 12; ++i) {
    bomb += "<!ENTITY l" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) {
      bomb += "&l" + std::to_string(i - 1) + ";";
    }
    bomb += "\">";
  }
  const HomeReading reading = read(bomb + "]><apartment id=\"a\" name=\"&l11;\" version=\"1\"><room id=\"r\" name=\"r\"/></apartment>");
  EXPECT_FALSE(reading.complete);
  ASSERT_EQ(reading.findings.size(), 1U);
  EXPECT_EQ(reading.findings[0].element, "document type");
  const HomeReading other = read("<!DOCTYPE a SYSTEM \"file:///etc/passwd\"><a>&x;</a>");
  ASSERT_FALSE(other.findings.empty());
  EXPECT_EQ(other.findings[0].element, "document type");
}

TEST_F(HomeReader, TenThousandLevelsAreRefused) {
  std::string deep;
  for (int i = 0; i < 10000; ++i) {
    deep += "<room>";
  }
  const HomeReading reading = read(deep);
  EXPECT_FALSE(reading.complete);
  EXPECT_LT(reading.findings.size(), 200U);
}

TEST_F(HomeReader, ThousandsOfErrorsAreCutShort) {
  std::string content = "<apartment id=\"a\" name=\"a\" version=\"1\"><room id=\"r\" name=\"r\">";
  for (int i = 0; i < 5000; ++i) {
    content += "<switch id=\"s\" kind=\"odd\" pose=\"0 0 0 0 0 0\"/>\n";
  }
  const HomeReading reading = read(content + "</room></apartment>");
  EXPECT_FALSE(reading.complete);
  EXPECT_EQ(reading.findings.back().found, "too many errors, the rest was not read");
  EXPECT_LE(reading.findings.size(), 1001U);
}

TEST_F(HomeReader, ElementsInTheWrongPlaceGoNowhere) {
  const HomeReading reading = read(
      "<apartment id=\"a\" name=\"a\" version=\"1\"><joint id=\"j\"/><smallObject id=\"s\"/><box/><state/><switch id=\"x\"/>"
      "<room id=\"r\" name=\"r\"><part id=\"p\"/><knob id=\"k\"/><parkingPose/><property/></room></apartment>");
  EXPECT_TRUE(reading.complete);
  EXPECT_TRUE(hasErrors(reading.findings));
  ASSERT_EQ(reading.home.rooms.size(), 1U);
  EXPECT_TRUE(reading.home.rooms[0].objects.empty());
}

}  // namespace
}  // namespace oikos::semantic
