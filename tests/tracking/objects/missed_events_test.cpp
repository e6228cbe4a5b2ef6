// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/missed_events.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace oikos::tracking {
namespace {

semantic::Home homeWithCup() {
  semantic::SmallObject cup;
  cup.id = {"cup"};
  cup.parent = "table";
  cup.T_parent_object = {{0.1, 0.2, 0.74}, {0.0, 0.0, 0.3}};
  semantic::LargeObject table;
  table.id = {"table"};
  table.small_objects.push_back(cup);
  semantic::Room room;
  room.objects.emplace_back(table);
  semantic::Home home;
  home.rooms.push_back(room);
  return home;
}

ObjectReading missedCup() {
  ObjectReading reading;
  reading.id = {"cup"};
  reading.placement = {"table", semantic::Relation::kOn, {{0.1, 0.2, 0.74}, {0.0, 0.0, 0.3}}};
  reading.status = WatchStatus::kMissed;
  reading.confidence = 0.999;
  reading.stamp_ns = 5;
  reading.frame = 7;
  return reading;
}

TEST(MissedEvents, SayWhereItWasLookedFor) {
  const auto event = missedEvent(missedCup(), homeWithCup(), 1000);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, semantic::EventKind::kMissed);
  EXPECT_EQ(event->subject, "cup");
  EXPECT_EQ(event->time_ns, 1005);
  EXPECT_EQ(event->frame, 7);
  EXPECT_EQ(std::get<semantic::Placement>(*event->after).parent, "table");
  EXPECT_NEAR(std::get<semantic::Placement>(*event->after).T_parent_object.position_m.y(), 0.2, 1e-12);
}

TEST(MissedEvents, NotOfWhatIsThereOrWasPutElsewhereMeanwhile) {
  ObjectReading there = missedCup();
  there.status = WatchStatus::kThere;
  EXPECT_FALSE(missedEvent(there, homeWithCup(), 0));
  semantic::Home moved = homeWithCup();
  moved.rooms[0].objects[0].edit().small_objects[0].T_parent_object.position_m.x() = 0.4;
  EXPECT_FALSE(missedEvent(missedCup(), moved, 0));
  semantic::Home removed = homeWithCup();
  removed.rooms[0].objects[0].edit().small_objects.clear();
  EXPECT_FALSE(missedEvent(missedCup(), removed, 0));
}

TEST(MissedEvents, AreKnownUntilSomethingElseIsHeardOfIt) {
  const test::TemporaryFolder folder;
  semantic::History history(folder.path() / "history.sqlite", semantic::HistoryAccess::kAppend);
  semantic::Event missed = *missedEvent(missedCup(), homeWithCup(), 1000);
  EXPECT_FALSE(isKnown(missed, history));
  history.append(std::vector{missed});
  missed.time_ns += 100;
  EXPECT_TRUE(isKnown(missed, history));
  semantic::Event elsewhere = missed;
  std::get<semantic::Placement>(*elsewhere.after).T_parent_object.position_m.x() = 0.5;
  EXPECT_FALSE(isKnown(elsewhere, history));
  semantic::Event seen = missed;
  seen.kind = semantic::EventKind::kSighted;
  history.append(std::vector{seen});
  missed.time_ns += 100;
  EXPECT_FALSE(isKnown(missed, history));
}

}  // namespace
}  // namespace oikos::tracking
