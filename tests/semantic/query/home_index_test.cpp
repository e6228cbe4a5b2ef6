// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/home_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "semantic/xml/home_reader.h"

namespace oikos::semantic {
namespace {

using Words = std::vector<std::string>;

/// `count` cups on as many tables, each of a colour and a label of its own where `special` says so.
Home manyCups(int count, int special) {
  Home home;
  home.vocabulary = builtInVocabulary();
  Room& room = home.rooms.emplace_back();
  room.id = {"hall"};
  room.name = "hall";
  LargeObject table;
  table.id = {"table"};
  table.type = "table";
  for (int i = 0; i < count; ++i) {
    SmallObject& cup = table.small_objects.emplace_back();
    cup.id = {"c" + std::to_string(i)};
    cup.type = "cup";
    cup.parent = "table";
    cup.properties = {{"color", i == special ? "blue" : "red"}};
  }
  room.objects.emplace_back(table);
  return home;
}

std::vector<std::string> idsOf(const HomeIndex& index, const Words& words) {
  std::vector<std::string> ids;
  for (const std::uint32_t number : index.find(words).best()) {
    ids.push_back(index.thing(number).id());
  }
  return ids;
}

LargeObject drawerUnit(const std::string& id, const std::string& label) {
  LargeObject unit;
  unit.id = {id};
  unit.type = "drawer_unit";
  unit.label = label;
  return unit;
}

/// "chest of drawers" is another word for all drawer units, and the label of one of them.
TEST(HomeIndexNames, ALabelOfSeveralWordsMeansTheOneThatIsCalledSo) {
  Home home = manyCups(1, 0);
  home.rooms.front().objects.emplace_back(drawerUnit("kitchen-drawers", "kitchen drawers"));
  home.rooms.front().objects.emplace_back(drawerUnit("chest", "chest of drawers"));
  home.rooms.front().objects.emplace_back(drawerUnit("linen-chest-drawers", "linen box"));
  EXPECT_EQ(idsOf(HomeIndex(home), {"chest of drawers"}), (Words{"chest"}));
  home.rooms.front().objects.erase(home.rooms.front().objects.begin() + 2);
  EXPECT_EQ(idsOf(HomeIndex(home), {"chest of drawers"}), (Words{"kitchen-drawers", "linen-chest-drawers"}));
}

class PapersIndex : public testing::Test {
 protected:
  Home home_ = readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml").home;
  HomeIndex index_{home_};
};

TEST_F(PapersIndex, EveryWordMustFit) {
  EXPECT_EQ(idsOf(index_, {"cup"}), (Words{"red-cup", "blue-cup"}));
  EXPECT_EQ(idsOf(index_, {"blue", "cup"}), (Words{"blue-cup"}));
  EXPECT_EQ(idsOf(index_, {"cup", "the", "blue"}), (Words{"blue-cup"}));
  EXPECT_TRUE(idsOf(index_, {"white", "cup"}).empty());
}

TEST_F(PapersIndex, SynonymsPluralsAndProperties) {
  EXPECT_EQ(idsOf(index_, {"mugs"}), (Words{"red-cup", "blue-cup"}));
  EXPECT_EQ(idsOf(index_, {"navy", "mug"}), (Words{"blue-cup"}));
  EXPECT_EQ(idsOf(index_, {"sugar"}), (Words{"sugar"}));
  EXPECT_EQ(idsOf(index_, {"refrigerator", "door"}), (Words{"fridge-door"}));
}

TEST_F(PapersIndex, AWordThatFitsNothingIsNotAnUnknownWord) {
  EXPECT_TRUE(index_.find({"green", "cup"}).unknown.empty());
  EXPECT_TRUE(index_.find({"green", "cup"}).matches.empty());
  EXPECT_EQ(index_.find({"ukulele"}).unknown, (Words{"ukulele"}));
}

TEST_F(PapersIndex, OneTypingErrorInFourLettersOrMore) {
  for (const char* slip : {"bleu", "blu", "bblue", "blux"}) {
    const bool long_enough = std::string(slip).size() >= 4;
    EXPECT_EQ(index_.find({slip, "cup"}).unknown.empty(), long_enough) << slip;
    EXPECT_EQ(idsOf(index_, {slip, "cup"}), long_enough ? Words{"blue-cup"} : Words{}) << slip;
  }
  EXPECT_EQ(index_.find({"bleu"}).corrected, (Words{"bleu -> blue"}));
  EXPECT_EQ(index_.find({"frdige"}).corrected, (Words{"frdige -> fridge"}));
  EXPECT_FALSE(index_.find({"frdgie"}).unknown.empty()) << "two errors";
  EXPECT_TRUE(index_.find({"blue"}).corrected.empty());
}

TEST_F(PapersIndex, ByIdAndItsPlaceInTheMap) {
  ASSERT_NE(index_.findById("blue-cup"), nullptr);
  EXPECT_EQ(index_.findById("nothing"), nullptr);
  const Eigen::Vector3d cup_map = index_.findById("blue-cup")->T_map_thing().translation();
  EXPECT_LT((cup_map - Eigen::Vector3d(2.1, -0.05, 0.75)).norm(), 1e-12) << cup_map.transpose();
}

TEST(HomeIndex, FindsTheOneAmongMany) {
  const Home home = manyCups(20000, 777);
  const HomeIndex index(home);
  EXPECT_EQ(idsOf(index, {"blue", "cup"}), (Words{"c777"}));
  EXPECT_EQ(index.find({"cup"}).matches.size(), 20000U);
}

TEST_F(PapersIndex, TheTypeRanksBeforeAnotherWordForIt) {
  Home home = home_;
  LargeObject desk = home.rooms[0].objects[0];
  desk.id = {"desk"};
  desk.label = "desk";
  desk.small_objects.clear();
  home.rooms[0].objects.emplace_back(desk);
  const HomeIndex index(home);
  EXPECT_EQ(idsOf(index, {"desk"}), (Words{"desk"}));  // the vocabulary has it as a word for any table
  EXPECT_EQ(index.find({"desk"}).matches.size(), 2U);
  EXPECT_EQ(idsOf(index_, {"desk"}), (Words{"table"}));
}

TEST_F(PapersIndex, NamesWithWordsOfTheSentence) {
  EXPECT_EQ(index_.words().joinNames({"the", "chest", "of", "drawers", "of", "mine"}), (Words{"the", "chest of drawers", "of", "mine"}));
  EXPECT_EQ(index_.words().nearestWords("fridje"), (Words{"fridge"}));
}

TEST_F(PapersIndex, TakesOverTheWordsForAHomeInAnotherState) {
  Home later = home_;
  std::vector<SmallObject>& on_table = later.rooms[0].objects[0].edit().small_objects;
  SmallObject cup = on_table[3];
  on_table.erase(on_table.begin() + 3);
  cup.parent = "bathroom";
  later.rooms[1].small_objects.push_back(cup);
  HomeIndex moved(index_, std::make_shared<const Home>(later));
  EXPECT_EQ(&moved.words(), &index_.words());
  ASSERT_EQ(moved.size(), index_.size());
  for (std::uint32_t i = 0; i < moved.size(); ++i) {
    EXPECT_EQ(moved.thing(i).id(), index_.thing(i).id());
  }
  EXPECT_EQ(moved.findById("blue-cup")->room->id.value, "bathroom");
  EXPECT_EQ(index_.findById("blue-cup")->room->id.value, "kitchen");
}

TEST_F(PapersIndex, DoesNotTakeOverTheWordsOfAnotherHome) {
  Home larger = home_;
  SmallObject spoon = home_.rooms[0].objects[0]->small_objects[0];
  spoon.id = {"spoon"};
  spoon.type = "spoon";
  larger.rooms[1].small_objects.push_back(spoon);
  const HomeIndex index(index_, std::make_shared<const Home>(larger));
  EXPECT_NE(&index.words(), &index_.words());
  EXPECT_EQ(idsOf(index, {"spoon"}), (Words{"spoon"}));
}

TEST_F(PapersIndex, KeepsItsHomeAlive) {
  auto index = std::make_unique<HomeIndex>(std::make_shared<const Home>(home_));
  const HomeIndex copy(*index);
  index.reset();
  EXPECT_EQ(copy.findById("blue-cup")->name(), "blue cup");
}

}  // namespace
}  // namespace oikos::semantic
