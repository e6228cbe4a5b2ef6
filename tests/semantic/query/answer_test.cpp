// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/answer.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "semantic/xml/home_reader.h"
#include "tests/semantic/papers_house.h"
#include "tests/semantic/query/ask.h"
#include "tests/support/enum_table_check.h"

namespace oikos::semantic {
namespace {

/// The papers' house after a while: the left cupboard door stands open, the blue cup is behind it, a bowl is on the bathroom's floor.
Home laterHouse() {
  Home home = papersHouse();
  LargeObject& cupboard = home.rooms[0].objects[1].edit();
  cupboard.articulation->joints[0].value = 1.2;
  std::vector<SmallObject>& on_table = home.rooms[0].objects[0].edit().small_objects;
  SmallObject cup = on_table[3];
  cup.parent = "cupboard-body";
  cup.relation = Relation::kIn;
  cup.T_parent_object = {.position_m = {0.0, 0.2, 0.8}};
  cupboard.small_objects.push_back(cup);
  SmallObject bowl = on_table[1];
  bowl.parent = "bathroom";
  home.rooms[1].small_objects.push_back(bowl);
  on_table.erase(on_table.begin() + 3);
  on_table.erase(on_table.begin() + 1);
  return home;
}

struct Row {
  const char* question;
  AnswerStatus status;
  std::vector<std::string> ids;
  const char* part_of_the_sentence;
};

void expectAnswers(const Home& home, const std::vector<Row>& rows) {
  const HomeIndex index(home);
  for (const Row& row : rows) {
    const Answer answer = answerQuestion({&index, nullptr, kNow_ns, std::nullopt}, row.question);
    std::vector<std::string> ids;
    for (const FoundThing& found : answer.found) {
      ids.push_back(found.id);
    }
    EXPECT_EQ(answer.status, row.status) << row.question << "\n" << answer.sentence;
    EXPECT_EQ(ids, row.ids) << row.question << "\n" << answer.sentence;
    EXPECT_NE(answer.sentence.find(row.part_of_the_sentence), std::string::npos) << row.question << "\n" << answer.sentence;
  }
}

constexpr AnswerStatus kAnswered = AnswerStatus::kAnswered;
constexpr AnswerStatus kNothing = AnswerStatus::kNothingFits;
constexpr AnswerStatus kUnknown = AnswerStatus::kUnknownWord;
constexpr AnswerStatus kNotUnderstood = AnswerStatus::kNotUnderstood;

/// The demo's oven, whose knobs go from 0 to 9, and its kitchen's drawers, of which the first is open.
Home demoHouse(const std::string& setting) {
  Home home = readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/demo/home.xml").home;
  for (Room& room : home.rooms) {
    for (CopyOnWrite<LargeObject>& object : room.objects) {
      if (object->id.value == "oven") {
        object.edit().articulation->knobs[2].current = setting;
      } else if (object->id.value == "drawers") {
        object.edit().articulation->joints[0].value = 0.25;
      }
    }
  }
  return home;
}

TEST(AnswerState, AKnobAtZeroIsOff) {
  const Home off = demoHouse("0");
  const HomeIndex index_off(off);
  EXPECT_EQ(answerQuestion({&index_off, nullptr, kNow_ns, {}}, "is the oven on?").yes, false);
  EXPECT_EQ(answerQuestion({&index_off, nullptr, kNow_ns, {}}, "is the oven off?").yes, true);
  const Home on = demoHouse("4");
  const HomeIndex index_on(on);
  const Answer answer = answerQuestion({&index_on, nullptr, kNow_ns, {}}, "is the oven on?");
  EXPECT_EQ(answer.yes, true);
  EXPECT_EQ(answer.sentence, "Yes: the third knob of the oven is set to 4.");
  EXPECT_EQ(answerQuestion({&index_on, nullptr, kNow_ns, {}}, "is the oven off?").yes, false);
}

TEST(AnswerState, OfDrawersThePieceThatHasThemIsNone) {
  const Home home = demoHouse("0");
  const HomeIndex index(home);
  EXPECT_EQ(answerQuestion({&index, nullptr, kNow_ns, {}}, "which drawers are open?").sentence,
            "The first drawer of the kitchen drawers is open by 25 cm.");
}

TEST(Answer, AboutThePapersHouse) {
  expectAnswers(papersHouse(),
                {{"where is the blue cup?", kAnswered, {"blue-cup"}, "The blue cup is on the kitchen table in the kitchen."},
                 {"Where's the sugar", kAnswered, {"sugar"}, "The sugar container is on the kitchen table"},
                 {"where are the cups", kAnswered, {"red-cup", "blue-cup"}, "2 things fit"},
                 {"can you tell me where the red cup is?", kAnswered, {"red-cup"}, "on the kitchen table"},
                 {"where can I find a bowl", kAnswered, {"bowl"}, "white bowl"},
                 {"find the mug on the table", kAnswered, {"red-cup", "blue-cup"}, ""},
                 {"where is the refrigerator", kAnswered, {"fridge"}, "The fridge is in the kitchen."},
                 {"where is the left door", kAnswered, {"cupboard-left"}, "left door of the cupboard"},
                 {"where is the green cup", kNothing, {}, "I know of no green cup."},
                 {"where is the cup in the bathroom", kNothing, {}, "in the bathroom"},
                 {"where is the ukulele", kUnknown, {}, "ukulele"},
                 {"what is on the table", kAnswered, {"red-cup", "bowl", "sugar", "blue-cup"}, "are on the table"},
                 {"which cups are on the table", kAnswered, {"red-cup", "blue-cup"}, ""},
                 {"what is under the table", kNothing, {}, "nothing under the table"},
                 {"what is in the kitchen",
                  kAnswered,
                  {"table", "red-cup", "bowl", "sugar", "blue-cup", "cupboard", "fridge"},
                  "and the fridge are in the kitchen"},
                 {"how many cups are there in the kitchen", kAnswered, {"red-cup", "blue-cup"}, "2: "},
                 {"how many cups are in the bathroom", kAnswered, {}, "None in the bathroom."},
                 {"is there a bowl in the bathroom", kAnswered, {}, "Not that I know: the white bowl is on"},
                 {"is the blue cup on the table", kAnswered, {"blue-cup"}, "Yes"},
                 {"is the fridge open", kAnswered, {"fridge"}, "No: the fridge is closed."},
                 {"is the table open", kNothing, {}, "no way to open the table"},
                 {"which doors are open", kAnswered, {}, "None."},
                 {"which doors are closed", kAnswered, {"cupboard-left", "cupboard-right", "fridge-door", "bathroom-door"}, "closed"},
                 {"what is the thermostat set to", kAnswered, {"fridge-thermostat"}, "is set to 3"},
                 {"what is the fridge set to", kAnswered, {"fridge-thermostat"}, "is set to 3"},
                 {"what is the table set to", kNothing, {}, "nothing that could be set"},
                 {"where was the cup yesterday", kNothing, {}, "no history"},
                 {"dance for me", kNotUnderstood, {}, "'dance'"},
                 {"where", kNotUnderstood, {}, ""},
                 {"", kNotUnderstood, {}, ""}});
}

TEST(Answer, AboutTheHouseLater) {
  expectAnswers(laterHouse(), {{"where is the blue cup", kAnswered, {"blue-cup"}, "The blue cup is in the cupboard in the kitchen."},
                               {"where is the bowl", kAnswered, {"bowl"}, "on the floor in the bathroom"},
                               {"what is in the cupboard", kAnswered, {"blue-cup"}, "The blue cup is in the cupboard."},
                               {"what is in the bathroom", kAnswered, {"bathroom-door", "bowl"}, ""},
                               {"which doors are open", kAnswered, {"cupboard-left"}, "open by 69 degrees"},
                               {"how far is the left door open", kAnswered, {"cupboard-left"}, "69 degrees"},
                               {"is the cupboard open", kAnswered, {"cupboard"}, "its right door is closed"}});
}

TEST(Answer, SaysWhereToStandAndWhatToOpenFirst) {
  const Home home = laterHouse();
  const Answer answer = ask(home, "where is the blue cup");
  ASSERT_EQ(answer.found.size(), 1U);
  const FoundThing& cup = answer.found[0];
  EXPECT_EQ(cup.parent, "cupboard-body");
  EXPECT_EQ(cup.relation, Relation::kIn);
  EXPECT_TRUE(cup.joints_to_move.empty());  // it is behind the left door, which is open
  ASSERT_EQ(cup.T_map_base.size(), 1U);
  // The cupboard stands at (3.2, 1.2), turned by 180 degrees; the robot 1.1 m before it, looking at it.
  EXPECT_LT((cup.T_map_base[0].translation() - Eigen::Vector3d(2.1, 1.2, 0.0)).norm(), 1e-12);
  EXPECT_LT((cup.T_map_base[0].linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT((cup.T_map_thing.translation() - Eigen::Vector3d(3.2, 1.0, 0.8)).norm(), 1e-12);
}

/// The joints to move first if the cup lies in the papers' cupboard at `y_m` from its middle and both doors are shut.
std::vector<std::string> doorsBefore(double y_m) {
  Home home = laterHouse();
  LargeObject& cupboard = home.rooms[0].objects[1].edit();
  cupboard.articulation->joints[0].value = 0.0;
  cupboard.small_objects.back().T_parent_object.position_m.y() = y_m;
  std::vector<std::string> joints;
  const Answer answer = ask(home, "where is the blue cup");
  for (const JointReading& joint : answer.found.at(0).joints_to_move) {
    joints.push_back(joint.id);
  }
  return joints;
}

TEST(Answer, TheDoorToOpenIsTheOneBeforeTheThing) {
  using Joints = std::vector<std::string>;
  EXPECT_EQ(doorsBefore(0.2), Joints{"cupboard-left-hinge"});
  EXPECT_EQ(doorsBefore(-0.2), Joints{"cupboard-right-hinge"});
  EXPECT_EQ(doorsBefore(0.0), (Joints{"cupboard-left-hinge", "cupboard-right-hinge"}));
}

TEST(Answer, TheDefaultParkingPoseIsTriedFirst) {
  Home home = papersHouse();
  auto& parking = home.rooms[0].objects[0].edit().parking_poses;
  std::swap(parking[0], parking[2]);
  const Answer answer = ask(home, "where is the table");
  ASSERT_EQ(answer.found[0].T_map_base.size(), 3U);
  EXPECT_NEAR(answer.found[0].T_map_base[0].translation().x(), 0.7, 1e-12);
}

TEST(Answer, TwentyOfManyAndTheNumberOfAll) {
  Home home = papersHouse();
  auto& on_table = home.rooms[0].objects[0].edit().small_objects;
  for (int i = 0; i < 40; ++i) {
    SmallObject spoon = on_table[0];
    spoon.id = {"spoon-" + std::to_string(i)};
    spoon.type = "spoon";
    on_table.push_back(spoon);
  }
  const Answer answer = ask(home, "where are the spoons");
  EXPECT_EQ(answer.found.size(), 20U);
  EXPECT_EQ(answer.total, 40U);
  EXPECT_NE(answer.sentence.find("32 more"), std::string::npos) << answer.sentence;
}

TEST(Answer, AsJson) {
  const Home home = papersHouse();
  const auto json = nlohmann::json::parse(toJson(ask(home, "where is the blue cup")));
  EXPECT_EQ(json["status"], "answered");
  EXPECT_EQ(json["total"], 1);
  EXPECT_EQ(json["found"][0]["id"], "blue-cup");
  EXPECT_DOUBLE_EQ(json["found"][0]["pose_map"]["x_m"], 2.1);
  EXPECT_DOUBLE_EQ(json["found"][0]["pose_map"]["yaw_deg"], 30.0);
  EXPECT_EQ(json["found"][0]["parking_poses_map"].size(), 3U);
  EXPECT_TRUE(json["found"][0]["last_seen"].is_null());
  EXPECT_TRUE(nlohmann::json::accept(toJson(ask(home, "where is \xFF\xFE"))));
}

TEST(Answer, EnumTable) {
  test::checkEnumTable(AnswerStatus::kNotUnderstood);
}

}  // namespace
}  // namespace oikos::semantic
