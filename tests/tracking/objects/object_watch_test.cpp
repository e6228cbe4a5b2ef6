// SPDX-License-Identifier: Apache-2.0
// A camera goes past a table and a chest of drawers with a simulated Kinect; what stands on and in them is looked for.
#include "tracking/objects/object_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/core.hpp>
#include <random>

#include "semantic/model/placement.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/analytic_room.h"
#include "tests/tracking/home_scene.h"

namespace oikos::tracking {
namespace {

using semantic::Home;

constexpr double kTop_m = 0.74;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kOpen_m = 0.3;
const Eigen::Vector3d kTable_map(0.0, 0.0, 0.0);
const Eigen::Vector3d kChest_map(1.6, 0.0, 0.0);

semantic::SmallObject small(const std::string& id, const semantic::Shape& shape, const std::string& parent, double x, double y, double z) {
  semantic::SmallObject object;
  object.id = {id};
  object.shape = shape;
  object.parent = parent;
  object.T_parent_object = {{x, y, z}, {0.0, 0.0, 0.3}};
  return object;
}

/// Where a part of the chest is, its upper drawer open or shut.
Eigen::Isometry3d drawerInMap(const semantic::LargeObject& chest) {
  return semantic::findCarrierInMap(chest, "chest-drawer_0").value();
}

double depthBelow(const semantic::LargeObject& chest, const Eigen::Vector3d& eye_map) {
  semantic::ModelMaker maker({});
  render::Scene scene;
  scene.add(maker.make(chest), chest.T_map_object.toIsometry(), semantic::jointValues(chest));
  scene.commit();
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.linear() = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  T_map_camera.translation() = eye_map;
  const camera::PinholeCamera ray{1, 1, 1.0, 1.0, 0.0, 0.0};
  return static_cast<double>(render::renderView(scene, render::CameraRays(ray), {T_map_camera, {}}, {}).depth_m.at<float>(0, 0));
}

/// A cup, a box and a plate on a table in the middle of a room; a carton in the upper drawer of a chest that stands shut at a wall.
Home believedHome() {
  semantic::LargeObject table;
  table.id = {"table"};
  table.shape = semantic::Shape{"table", {{"width_m", "1.1"}, {"depth_m", "0.75"}, {"height_m", "0.74"}}};
  table.movability = semantic::Movability::kShiftable;
  table.small_objects = {small("cup", {"cup", {}}, "table", 0.1, 0.2, kTop_m),
                         small("box", {"box", {{"width_m", "0.12"}, {"depth_m", "0.1"}, {"height_m", "0.15"}}}, "table", 0.1, -0.2, kTop_m),
                         small("plate", {"plate", {}}, "table", -0.1, 0.0, kTop_m)};
  semantic::LargeObject chest;
  chest.id = {"chest"};
  chest.shape = semantic::Shape{"drawer_unit", {}};
  chest.articulation = semantic::articulationOf(semantic::makeShape(*chest.shape, "chest"), chest.id);
  chest.T_map_object = {kChest_map, {0.0, 0.0, std::numbers::pi}};
  semantic::LargeObject opened = chest;
  opened.articulation->joints[0].value = kOpen_m;
  const double front_x_m = kChest_map.x() - 0.29 - 0.5 * kOpen_m;
  const double bottom_m = 1.5 - depthBelow(opened, {front_x_m, 0.0, 1.5});
  const Eigen::Isometry3d T_map_carton(Eigen::Translation3d(front_x_m, 0.0, bottom_m));
  semantic::SmallObject carton =
      small("carton", {"box", {{"width_m", "0.14"}, {"depth_m", "0.12"}, {"height_m", "0.16"}}}, "chest-drawer_0", 0.0, 0.0, 0.0);
  carton.relation = semantic::Relation::kIn;
  carton.T_parent_object = semantic::Pose::fromIsometry(drawerInMap(opened).inverse() * T_map_carton);
  chest.small_objects = {carton};
  semantic::Room room;
  room.id = {"room"};
  room.outline_map = {{-2.5, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {-2.5, 2.0}};
  room.objects = {table, chest};
  Home home;
  home.rooms.push_back(room);
  return home;
}

semantic::SmallObject& objectOf(Home& home, std::size_t piece, const std::string& id) {
  auto& objects = home.rooms[0].objects[piece].edit().small_objects;
  return *std::find_if(objects.begin(), objects.end(), [&](const semantic::SmallObject& one) { return one.id.value == id; });
}

Home without(Home home, const std::string& id) {
  for (auto& object : home.rooms[0].objects) {
    std::erase_if(object.edit().small_objects, [&](const semantic::SmallObject& one) { return one.id.value == id; });
  }
  return home;
}

/// What is really there: the home as it is, and perhaps a post.
render::Scene sceneOf(const Home& home, const std::optional<Eigen::Vector3d>& post_map = std::nullopt) {
  render::Scene scene;
  addBox(scene, {-2.5F, -2.0F, -0.1F}, {2.0F, 2.0F, 0.0F});
  addBox(scene, {2.0F, -2.0F, 0.0F}, {2.1F, 2.0F, 2.5F});
  addBox(scene, {-2.5F, 2.0F, 0.0F}, {2.0F, 2.1F, 2.5F});
  if (post_map) {
    const Eigen::Vector3f half(0.1F, 0.1F, 0.0F);
    const Eigen::Vector3f middle = post_map->cast<float>();
    addBox(scene, middle - half, middle + half + Eigen::Vector3f(0.0F, 0.0F, 1.8F));
  }
  addFurniture(scene, home);
  scene.commit();
  return scene;
}

geometry::Vector6d poseSigma() {
  geometry::Vector6d sigma;
  sigma << 0.006, 0.006, 0.006, 0.004, 0.004, 0.004;
  return sigma;
}

/// A way past the table, or past the open drawer.
struct Drive {
  int frames = 6;
  double height_m = 1.15;
  double distance_m = 1.4;
  Eigen::Vector3d target_map = kTable_map + Eigen::Vector3d(0.0, 0.0, kTop_m);
  double sigma_share = 1.0;  ///< by how many of its deviations a pose is off
  double covariance_scale = 1.0;
  std::uint64_t seed = 1;

  [[nodiscard]] Eigen::Isometry3d camera(int frame) const {
    const double angle = (150.0 + 9.0 * frame) * kDegree;
    Eigen::Vector3d eye = target_map + distance_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    eye.z() = height_m;
    return test::lookAt(eye, target_map);
  }
  [[nodiscard]] WatchFrame believed(int frame) const {
    std::mt19937_64 random(100 * seed + static_cast<std::uint64_t>(frame));
    std::normal_distribution<double> normal;
    geometry::Vector6d error;
    for (int i = 0; i < 6; ++i) {
      error(i) = sigma_share * poseSigma()(i) * normal(random);
    }
    WatchFrame found;
    found.frame = frame;
    found.stamp_ns = frame * 500'000'000LL;
    found.T_map_camera = camera(frame) * geometry::expSe3(error);
    found.covariance = covariance_scale * geometry::Matrix6d(poseSigma().cwiseAbs2().asDiagonal());
    return found;
  }
};

/// By object; what stands in the scene may depend on the frame.
std::map<std::string, ObjectReading> watched(const Drive& drive, const std::function<render::Scene(int)>& scene_of,
                                             const CarrierReadings& carriers = {}) {
  std::vector<WatchFrame> frames;
  for (int i = 0; i < drive.frames; ++i) {
    frames.push_back(drive.believed(i));
  }
  ObjectWatch watch(believedHome(), {}, carriers, frames, test::kinectCamera(), {});
  for (std::vector<int> wanted = watch.wanted(); !wanted.empty(); wanted = watch.wanted()) {
    for (const int number : wanted) {
      camera::RgbdFrame frame;
      frame.index = number;
      frame.depth_m = test::sensed(test::viewOf(scene_of(number), test::kinectCamera(), drive.camera(number)), test::kinectCamera(),
                                   camera::DepthSensorKind::kKinect1, 1000 * drive.seed + static_cast<std::uint64_t>(number));
      watch.look(frame, frames[static_cast<std::size_t>(number)]);
    }
  }
  std::map<std::string, ObjectReading> readings;
  for (const ObjectReading& reading : watch.conclude()) {
    readings[reading.id.value] = reading;
  }
  return readings;
}

std::map<std::string, ObjectReading> watched(const Drive& drive, const Home& real,
                                             const std::optional<Eigen::Vector3d>& post_map = std::nullopt,
                                             const CarrierReadings& carriers = {}) {
  return watched(
      drive, [&](int) { return sceneOf(real, post_map); }, carriers);
}

TEST(ObjectWatch, WhatIsInItsPlaceIsNotMissedWhateverTheNoise) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Drive drive;
    drive.seed = seed;
    const auto readings = watched(drive, believedHome());
    EXPECT_EQ(readings.at("cup").status, WatchStatus::kThere) << seed;
    EXPECT_EQ(readings.at("box").status, WatchStatus::kThere) << seed;
    EXPECT_NE(readings.at("plate").status, WatchStatus::kMissed) << seed;
    EXPECT_FALSE(readings.contains("carton")) << "in a drawer that is shut";
  }
}

TEST(ObjectWatch, WhatHasGoneIsMissedWithItsMomentAndItsPicture) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Drive drive;
    drive.seed = seed;
    const auto readings = watched(drive, without(believedHome(), "cup"));
    const ObjectReading& cup = readings.at("cup");
    ASSERT_EQ(cup.status, WatchStatus::kMissed) << seed;
    EXPECT_EQ(cup.placement.parent, "table");
    EXPECT_GE(cup.not_there, 2);
    EXPECT_GT(cup.confidence, 0.99);
    EXPECT_EQ(cup.stamp_ns, cup.frame * 500'000'000LL);
    const Eigen::Vector2d middle =
        test::kinectCamera().project(drive.camera(cup.evidence_frame).inverse() * Eigen::Vector3d(0.1, 0.2, kTop_m + 0.05));
    EXPECT_TRUE(middle.x() > cup.crop.left && middle.x() < cup.crop.right && middle.y() > cup.crop.top && middle.y() < cup.crop.bottom);
    EXPECT_LT(cup.crop.right - cup.crop.left, 250);
    EXPECT_EQ(readings.at("box").status, WatchStatus::kThere) << seed;
  }
}

TEST(ObjectWatch, BehindAPostNothingIsMissed) {
  const Drive drive;
  const Eigen::Vector3d cup_map(0.1, 0.2, 0.0);
  const auto readings = watched(drive, [&](int frame) {
    Eigen::Vector3d post_map = 0.5 * (cup_map + drive.camera(frame).translation());
    post_map.z() = 0.0;
    return sceneOf(without(believedHome(), "cup"), post_map);
  });
  EXPECT_EQ(readings.at("cup").status, WatchStatus::kHidden);
  EXPECT_EQ(readings.at("cup").not_there, 0);
}

TEST(ObjectWatch, NudgedIsThereAndMovedAwayIsMissed) {
  Home nudged = believedHome();
  objectOf(nudged, 0, "cup").T_parent_object.position_m += Eigen::Vector3d(0.03, 0.02, 0.0);
  EXPECT_EQ(watched(Drive(), nudged).at("cup").status, WatchStatus::kThere) << "half of its place is covered still";
  Home moved = believedHome();
  objectOf(moved, 0, "cup").T_parent_object.position_m += Eigen::Vector3d(-0.3, 0.0, 0.0);
  EXPECT_EQ(watched(Drive(), moved).at("cup").status, WatchStatus::kMissed);
}

TEST(ObjectWatch, SomethingElseInItsPlaceIsNoMiss) {
  Home other = believedHome();
  objectOf(other, 0, "cup").shape = semantic::Shape{"tin", {}};
  EXPECT_EQ(watched(Drive(), other).at("cup").status, WatchStatus::kThere);
}

TEST(ObjectWatch, APlateSeenFlatCannotBeTold) {
  Drive drive;
  drive.height_m = 0.84;
  for (const bool is_gone : {false, true}) {
    const auto readings = watched(drive, is_gone ? without(believedHome(), "plate") : believedHome());
    EXPECT_TRUE(!readings.contains("plate") || readings.at("plate").status != WatchStatus::kMissed) << is_gone;
  }
}

TEST(ObjectWatch, TakenAwayMeanwhileIsMissedFromThenOn) {
  constexpr int kTaken = 4;
  Drive drive;
  drive.frames = 14;
  const auto readings =
      watched(drive, [&](int frame) { return sceneOf(frame < kTaken ? believedHome() : without(believedHome(), "cup")); });
  const ObjectReading& cup = readings.at("cup");
  ASSERT_EQ(cup.status, WatchStatus::kMissed);
  EXPECT_GE(cup.frame, kTaken);
  EXPECT_GE(cup.evidence_frame, kTaken);
}

TEST(ObjectWatch, APoseThatMayBeFarOffSaysNothing) {
  Drive drive;
  drive.covariance_scale = 60.0;
  EXPECT_EQ(watched(drive, without(believedHome(), "cup")).at("cup").status, WatchStatus::kUnclear);
}

TEST(ObjectWatch, PosesOffByTwoOfTheirDeviationsMakeNoMiss) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Drive drive;
    drive.seed = seed;
    drive.sigma_share = 2.0;
    for (const auto& [id, reading] : watched(drive, believedHome())) {
      EXPECT_NE(reading.status, WatchStatus::kMissed) << id << ' ' << seed;
    }
  }
}

TEST(ObjectWatch, WhatWentWithATableThatWasPushedIsNotMissed) {
  Home pushed = believedHome();
  pushed.rooms[0].objects[0].edit().T_map_object.position_m += Eigen::Vector3d(0.05, 0.25, 0.0);
  for (const auto& [id, reading] : watched(Drive(), pushed)) {
    EXPECT_NE(reading.status, WatchStatus::kMissed) << id;
  }
}

TEST(ObjectWatch, OfAPieceThatWasFoundElsewhereNothingIsLookedFor) {
  FurniturePlace place;
  place.id = {"table"};
  place.T_map_object = Eigen::Isometry3d(Eigen::Translation3d(0.3, 0.0, 0.0));
  EXPECT_TRUE(watched(Drive(), believedHome(), std::nullopt, {{}, {place}}).empty());
  place.T_map_object.translation().x() = 0.01;
  EXPECT_EQ(watched(Drive(), believedHome(), std::nullopt, {{}, {place}}).at("cup").status, WatchStatus::kThere);
  EXPECT_TRUE(watched(Drive(), believedHome(), std::nullopt, {{{{"chest"}, true, {}}}, {}}).contains("cup"));
}

/// What the recording has found of the chest's upper drawer.
CarrierReadings drawerAt(double value_m, registration::JointStatus status) {
  registration::JointSpan span;
  span.status = status;
  span.last_ns = 100'000'000'000;
  span.value = value_m;
  span.variance = 0.004 * 0.004;
  CarrierReadings carriers;
  carriers.pieces.push_back({{"chest"}, false, {{{"chest-drawer_0-joint"}, {span}}}});
  return carriers;
}

TEST(ObjectWatch, InADrawerItIsLookedForWhereTheDrawerIs) {
  Drive drive;
  drive.target_map = {kChest_map.x() - 0.29 - 0.5 * kOpen_m, 0.0, 0.7};
  drive.distance_m = 0.55;
  drive.height_m = 1.75;
  Home open = believedHome();
  open.rooms[0].objects[1].edit().articulation->joints[0].value = kOpen_m;
  open.rooms[0].objects.erase(open.rooms[0].objects.begin());  // the table would stand in the way
  const CarrierReadings found = drawerAt(kOpen_m, registration::JointStatus::kFound);
  const auto there = watched(drive, open, std::nullopt, found);
  ASSERT_TRUE(there.contains("carton"));
  EXPECT_EQ(there.at("carton").status, WatchStatus::kThere);
  const auto gone = watched(drive, without(open, "carton"), std::nullopt, found);
  EXPECT_EQ(gone.at("carton").status, WatchStatus::kMissed);
  const CarrierReadings unsure = drawerAt(kOpen_m, registration::JointStatus::kAmbiguous);
  EXPECT_FALSE(watched(drive, without(open, "carton"), std::nullopt, unsure).contains("carton"));
  EXPECT_FALSE(watched(drive, believedHome(), std::nullopt, drawerAt(0.0, registration::JointStatus::kFound)).contains("carton"));
}

}  // namespace
}  // namespace oikos::tracking
