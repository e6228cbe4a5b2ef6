// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/home_edits.h"

#include <gtest/gtest.h>

#include "tests/semantic/papers_house.h"
#include "tests/support/random_home.h"

namespace oikos::semantic {
namespace {

Event onlyEdit(const Home& before, const Home& after) {
  const std::vector<Event> events = editsBetween(before, after, 42);
  EXPECT_EQ(events.size(), 1U);
  return events.empty() ? Event{} : events.front();
}

TEST(HomeEdits, NoneBetweenEqualHomes) {
  EXPECT_TRUE(editsBetween(papersHouse(), papersHouse(), 0).empty());
  EXPECT_TRUE(editsBetween(test::randomHome(3), test::randomHome(3), 0).empty());
  Home later = papersHouse();
  later.as_of = 7;
  EXPECT_TRUE(editsBetween(papersHouse(), later, 0).empty());
}

TEST(HomeEdits, AStateThatChangedHasBothSides) {
  const Home before = papersHouse();
  Home after = before;
  Joint& hinge = after.rooms[0].objects[2].edit().articulation->joints[0];
  hinge.value = 1.0;
  const Event event = onlyEdit(before, after);
  EXPECT_EQ(event.kind, EventKind::kEdited);
  EXPECT_EQ(event.subject, hinge.id.value);
  EXPECT_EQ(event.time_ns, 42);
  EXPECT_EQ(std::get<JointValue>(*event.before).value, 0.0);
  EXPECT_EQ(std::get<JointValue>(*event.after).value, 1.0);
}

TEST(HomeEdits, WhatIsNoStateHasNeither) {
  const Home before = papersHouse();
  Home after = before;
  after.rooms[0].objects[0].edit().small_objects[3].label = "grandmother's cup";
  Event event = onlyEdit(before, after);
  EXPECT_EQ(event.kind, EventKind::kEdited);
  EXPECT_EQ(event.subject, "blue-cup");
  EXPECT_FALSE(event.before || event.after);
  after = before;
  after.rooms[1].name = "bath";
  EXPECT_EQ(onlyEdit(before, after).subject, "bathroom");
  after = before;
  after.time_zone = "Asia/Tokyo";
  EXPECT_EQ(onlyEdit(before, after).subject, before.id);
}

TEST(HomeEdits, WhatComesAndWhatGoes) {
  const Home before = papersHouse();
  Home after = before;
  auto& on_table = after.rooms[0].objects[0].edit().small_objects;
  const std::string gone = on_table[0].id.value;
  on_table[0].id.value = "new-one";
  const std::vector<Event> events = editsBetween(before, after, 0);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::kAdded);
  EXPECT_EQ(events[0].subject, "new-one");
  EXPECT_EQ(std::get<Placement>(*events[0].after).parent, "table");
  EXPECT_FALSE(events[0].before);
  EXPECT_EQ(events[1].kind, EventKind::kRemoved);
  EXPECT_EQ(events[1].subject, gone);
  EXPECT_FALSE(events[1].after);
}

TEST(HomeEdits, AnObjectThatMovesIsOneEditOfItAlone) {
  const Home before = papersHouse();
  Home after = before;
  auto& on_table = after.rooms[0].objects[0].edit().small_objects;
  SmallObject cup = on_table[3];
  on_table.erase(on_table.begin() + 3);
  cup.parent = "bathroom";
  after.rooms[1].small_objects.push_back(cup);
  const Event event = onlyEdit(before, after);
  EXPECT_EQ(event.subject, "blue-cup");
  EXPECT_EQ(std::get<Placement>(*event.after).parent, "bathroom");
}

}  // namespace
}  // namespace oikos::semantic
