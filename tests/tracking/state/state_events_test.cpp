// SPDX-License-Identifier: Apache-2.0
// What recordings say becomes events: where shiftable furniture stands, and the order of all kinds. Joints: state_reader_test; knobs:
// knob_watch_test.
#include "tracking/state/state_events.h"

#include <gtest/gtest.h>

#include "semantic/model/home_models.h"

namespace oikos::tracking {
namespace {

/// A desk at (2, 1) that faces y, beside a fridge.
semantic::Home homeWithDesk() {
  semantic::LargeObject desk;
  desk.id = {"desk"};
  desk.type = "desk";
  desk.movability = semantic::Movability::kShiftable;
  desk.T_map_object = {{2.0, 1.0, 0.0}, {0.0, 0.0, 90.0 * semantic::kRadPerDeg}};
  semantic::LargeObject fridge;
  fridge.id = {"fridge"};
  fridge.type = "fridge";
  fridge.shape = semantic::Shape{"fridge", {}};
  fridge.articulation = semantic::articulationOf(semantic::makeShape(*fridge.shape, "fridge"), fridge.id);
  semantic::Room room;
  room.id = {"study"};
  room.objects.emplace_back(desk);
  room.objects.emplace_back(fridge);
  semantic::Home home;
  home.rooms.push_back(room);
  return home;
}

FurniturePlace placeAt(double x_m, double y_m, double yaw_deg) {
  FurniturePlace place;
  place.id = {"desk"};
  place.T_map_object = semantic::Pose{{x_m, y_m, 0.0}, {0.0, 0.0, yaw_deg * semantic::kRadPerDeg}}.toIsometry();
  place.views = 3;
  place.spread_m = 0.004;
  place.fit = 0.8;
  place.stamp_ns = 5'000;
  place.frame = 12;
  return place;
}

std::vector<StateEvent> eventsOf(const FurniturePlace& place) {
  RecordingStates states;
  states.furniture = {place};
  return stateEvents(states, homeWithDesk(), {"monday", 1'000'000}, {});
}

TEST(StateEvents, FurnitureThatWasPushedHasMoved) {
  const std::vector<StateEvent> events = eventsOf(placeAt(2.06, 1.0, 90.0));
  ASSERT_EQ(events.size(), 1U);
  const semantic::Event& event = events[0].event;
  EXPECT_EQ(event.kind, semantic::EventKind::kMoved);
  EXPECT_EQ(event.subject, "desk");
  EXPECT_EQ(event.recording, "monday");
  EXPECT_EQ(event.time_ns, 1'005'000);
  EXPECT_EQ(event.frame, 12);
  EXPECT_EQ(std::get<semantic::FurniturePose>(*event.before).T_map_object.position_m, Eigen::Vector3d(2.0, 1.0, 0.0));
  const semantic::Pose after = std::get<semantic::FurniturePose>(*event.after).T_map_object;
  EXPECT_NEAR(after.position_m.x(), 2.06, 1e-9);
  EXPECT_NEAR(after.roll_pitch_yaw_rad.z(), 90.0 * semantic::kRadPerDeg, 1e-9);
  EXPECT_EQ(event.confidence, 0.8);
  EXPECT_EQ(events[0].word, "moved");
  EXPECT_EQ(events[0].evidence_frame, 12);
}

TEST(StateEvents, AsFarAsATapeIsWrongItHasNot) {
  EXPECT_TRUE(eventsOf(placeAt(2.03, 1.02, 92.0)).empty());
  EXPECT_EQ(eventsOf(placeAt(2.0, 1.0, 86.5)).size(), 1U);  // turned
}

TEST(StateEvents, WhatTheHomeNoLongerHasIsPassedOver) {
  FurniturePlace place = placeAt(3.0, 1.0, 90.0);
  place.id = {"sofa"};
  EXPECT_TRUE(eventsOf(place).empty());
}

TEST(StateEvents, AllKindsComeInTheOrderOfTime) {
  RecordingStates states;
  states.furniture = {placeAt(3.0, 1.0, 90.0)};  // at 5 us
  JointStay open;
  open.span.status = registration::JointStatus::kFound;
  open.span.value = 1.0;
  open.span.variance = 1e-4;
  open.span.confidence = 1.0;
  open.first_ns = 9'000;
  open.images = open.found = 3;
  const registration::JointSighting silent;  // the stay's first image is its moment
  states.pieces = {{{"fridge"}, 3, 3, 3, 0, {{{"fridge-door-joint"}, semantic::JointType::kRevolute, {open}, {silent}, {0}}}, {}}};
  std::vector<StateEvent> events = stateEvents(states, homeWithDesk(), {"monday", 0}, {});
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].event.subject, "desk");
  EXPECT_EQ(events[1].event.subject, "fridge-door-joint");
  states.pieces[0].joints[0].stays[0].first_ns = 2'000;
  events = stateEvents(states, homeWithDesk(), {"monday", 0}, {});
  EXPECT_EQ(events[0].event.subject, "fridge-door-joint");
}

}  // namespace
}  // namespace oikos::tracking
