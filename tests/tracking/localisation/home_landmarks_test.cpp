// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/home_landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "registration/scan.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/analytic_room.h"
#include "tests/support/expect_error.h"

namespace oikos::tracking {
namespace {

const std::filesystem::path kDemo = std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/demo";

semantic::Home demoHome() {
  return semantic::getHome(semantic::readHome(kDemo / "home.xml"), kDemo / "home.xml");
}

/// A scan that has a reading everywhere.
registration::Scan fullScan() {
  registration::Scan scan;
  scan.camera = {160, 120, 131.25, 131.25, 79.875, 59.875};
  scan.points.resize(static_cast<std::size_t>(160 * 120));
  for (registration::ScanPoint& point : scan.points) {
    point.point_camera = {0.0F, 0.0F, 1.0F};
  }
  return scan;
}

int pixelsOf(const registration::LandmarkScene& landmarks, const std::string& id, const Eigen::Isometry3d& T_map_camera) {
  const std::vector<int> pixels = landmarks.countInView(fullScan(), T_map_camera, 1);
  int sum = 0;
  for (std::size_t s = 0; s < pixels.size(); ++s) {
    sum += landmarks.ids()[static_cast<std::size_t>(landmarks.surfaces()[s].landmark)] == id ? pixels[s] : 0;
  }
  return sum;
}

/// S220, S223: what is easily moved is no landmark.
TEST(HomeLandmarks, OnlyFixedFurniture) {
  const semantic::Home home = demoHome();
  const registration::LandmarkScene landmarks = makeLandmarks(home, kDemo);
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      const bool is_landmark = std::count(landmarks.ids().begin(), landmarks.ids().end(), object.id.value) == 1;
      EXPECT_EQ(is_landmark, object.movability == semantic::Movability::kFixed) << object.id.value;
    }
  }
}

TEST(HomeLandmarks, WhatIsShiftableOnDemand) {
  const semantic::Home home = demoHome();
  const registration::LandmarkScene landmarks = makeLandmarks(home, kDemo, {.has_shiftable = true});
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      const bool is_landmark = std::count(landmarks.ids().begin(), landmarks.ids().end(), object.id.value) == 1;
      EXPECT_EQ(is_landmark, object.movability != semantic::Movability::kMovable) << object.id.value;
    }
  }
}

/// A square room of 4 m with a cupboard at the wall that runs along y = 0, and one that stands free.
TEST(HomeLandmarks, WallsWithFurnitureOnDemand) {
  semantic::Home home;
  semantic::Room room;
  room.id = semantic::RoomId("den");
  room.outline_map = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}};
  for (const auto& [id, y_m] : {std::pair{"at-the-wall", 0.3}, {"free", 2.0}}) {
    semantic::LargeObject object;
    object.id = semantic::ObjectId(id);
    object.movability = semantic::Movability::kFixed;
    object.T_map_object.position_m = {2.0, y_m, 0.0};
    object.shape = semantic::Shape{"cabinet", {}};
    room.objects.emplace_back(object);
  }
  home.rooms.push_back(room);
  EXPECT_EQ(makeLandmarks(home, kDemo).ids(), (std::vector<std::string>{"at-the-wall", "free"}));
  const registration::LandmarkScene landmarks = makeLandmarks(home, kDemo, {.has_walls = true});
  EXPECT_EQ(landmarks.ids(), (std::vector<std::string>{"den/wall-1", "at-the-wall", "free"}));
  const LandmarkChoice fewer{.has_walls = true, .without = {"den/wall-1", "free"}};
  EXPECT_EQ(makeLandmarks(home, kDemo, fewer).ids(), (std::vector<std::string>{"at-the-wall"}));
  const Eigen::Isometry3d T_map_before_wall = test::lookAt({0.7, 2.0, 1.2}, {0.7, 0.0, 1.2});
  EXPECT_GT(pixelsOf(landmarks, "den/wall-1", T_map_before_wall), 5000);
  const Eigen::Isometry3d T_map_away = test::lookAt({2.0, 3.0, 1.2}, {2.0, 4.0, 1.2});
  EXPECT_EQ(pixelsOf(landmarks, "den/wall-1", T_map_away), 0);
}

TEST(HomeLandmarks, DoorsMoveAndCarcassesDoNot) {
  const registration::LandmarkScene landmarks = makeLandmarks(demoHome(), kDemo);
  int bases = 0;
  int doors = 0;
  for (const registration::LandmarkSurface& surface : landmarks.surfaces()) {
    if (landmarks.ids()[static_cast<std::size_t>(surface.landmark)] == "fridge") {
      bases += surface.is_base ? 1 : 0;
      doors += surface.part.find("door") != std::string::npos && !surface.is_base ? 1 : 0;
    }
  }
  EXPECT_EQ(bases, 1);
  EXPECT_GE(doors, 1);
}

/// The picture of the next room hangs 12 cm behind what is seen here.
TEST(HomeLandmarks, NothingIsSeenThroughAWall) {
  const registration::LandmarkScene landmarks = makeLandmarks(demoHome(), kDemo);
  const Eigen::Isometry3d T_map_in_kitchen = test::lookAt({0.35, 2.6, 1.3}, {0.35, 0.9, 1.4});
  const Eigen::Isometry3d T_map_in_hall = test::lookAt({0.35, -0.5, 1.3}, {0.35, 0.9, 1.4});
  EXPECT_EQ(pixelsOf(landmarks, "hall-picture-1", T_map_in_kitchen), 0);
  EXPECT_GT(pixelsOf(landmarks, "hall-picture-1", T_map_in_hall), 20);
  const Eigen::Isometry3d T_map_before_fridge = test::lookAt({0.3, 2.2, 1.3}, {-0.28, 4.27, 0.9});
  EXPECT_GT(pixelsOf(landmarks, "fridge", T_map_before_fridge), 500);
}

TEST(HomeLandmarks, AWrongIdSaysWhatItIs) {
  const semantic::Home home = demoHome();
  const registration::LandmarkScene landmarks = makeLandmarks(home, kDemo);
  EXPECT_EQ(landmarks.ids()[static_cast<std::size_t>(getLandmark(landmarks, home, "fridge"))], "fridge");
  test::expectError(base::ErrorCode::kUsage, {"--object", "'kitchen-chair-1' is movable"},
                    [&] { (void)getLandmark(landmarks, home, "kitchen-chair-1"); });
  test::expectError(base::ErrorCode::kUsage, {"--object", "no furniture 'frigde'", "'fridge'"},
                    [&] { (void)getLandmark(landmarks, home, "frigde"); });
}

}  // namespace
}  // namespace oikos::tracking
