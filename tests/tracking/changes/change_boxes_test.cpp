// SPDX-License-Identifier: Apache-2.0
// A corner with a cupboard and a crate on a shelf, mapped, and seen again when something has changed.
#include "tracking/changes/change_boxes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "semantic/model/placement.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/analytic_room.h"
#include "tests/tracking/home_scene.h"

namespace oikos::tracking {
namespace {

using semantic::Home;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kOpen_rad = 90.0 * kDegree;

/// x towards the room: a cupboard at its back wall x = -1, a low bench beside it with a crate on it.
Home cornerHome() {
  semantic::LargeObject cupboard;
  cupboard.id = {"cupboard"};
  cupboard.shape = semantic::Shape{"cabinet", {{"door_count", "1"}, {"height_m", "0.88"}}};
  cupboard.articulation = semantic::articulationOf(semantic::makeShape(*cupboard.shape, "cupboard"), cupboard.id);
  cupboard.T_map_object.position_m = {-0.7, 0.5, 0.0};
  semantic::SmallObject crate;
  crate.id = {"crate"};
  crate.shape = semantic::Shape{"box", {{"width_m", "0.3"}, {"depth_m", "0.3"}, {"height_m", "0.3"}}};
  crate.parent = "bench";
  crate.T_parent_object.position_m = {0.0, 0.0, 0.45};
  semantic::LargeObject bench;
  bench.id = {"bench"};
  bench.shape = semantic::Shape{"box", {{"width_m", "0.8"}, {"depth_m", "0.5"}, {"height_m", "0.45"}}};
  bench.T_map_object.position_m = {-0.7, -0.6, 0.0};
  bench.small_objects = {crate};
  semantic::Room room;
  room.id = {"room"};
  room.outline_map = {{-1.0, -2.0}, {3.0, -2.0}, {3.0, 2.0}, {-1.0, 2.0}};
  room.objects = {cupboard, bench};
  Home home;
  home.rooms.push_back(room);
  return home;
}

/// What is really there, and perhaps a parcel on the floor.
render::Scene sceneOf(const Home& home, bool has_parcel) {
  render::Scene scene;
  addBox(scene, {-1.0F, -2.0F, -0.1F}, {3.0F, 2.0F, 0.0F});
  addBox(scene, {-1.1F, -2.0F, 0.0F}, {-1.0F, 2.0F, 2.5F});
  if (has_parcel) {
    addBox(scene, {0.4F, -0.5F, 0.0F}, {0.8F, -0.1F, 0.35F});
  }
  addFurniture(scene, home);
  scene.commit();
  return scene;
}

camera::PinholeCamera halfCamera() {
  return {320, 240, 262.5, 262.5, 159.5, 119.5};
}

Eigen::Isometry3d cameraAt(int i) {
  const double angle = (-40.0 + 16.0 * i) * kDegree;
  const Eigen::Vector3d target(-0.3, 0.0, 0.3);
  Eigen::Vector3d eye = target + 2.2 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
  eye.z() = 1.2 + 0.1 * (i % 2);
  return test::lookAt(eye, target);
}

class ChangeBoxes : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    map_ = new mapping::SeenSpace({}, {}, 1);
    const render::Scene scene = sceneOf(cornerHome(), false);
    for (int i = 0; i < 6; ++i) {
      camera::RgbdFrame frame;
      frame.depth_m = test::viewOf(scene, halfCamera(), cameraAt(i)).depth_m;
      map_->insert({frame, halfCamera(), cameraAt(i)});
    }
  }
  static void TearDownTestSuite() {
    delete map_;
    map_ = nullptr;
  }

  static std::vector<ChangeBox> boxes(const Home& real, bool has_parcel, const CarrierReadings& carriers = {},
                                      const std::vector<ObjectReading>& objects = {}) {
    const render::Scene scene = sceneOf(real, has_parcel);
    std::vector<ChangeView> views;
    for (int i = 0; i < 6; ++i) {
      mapping::LocatedScan scan{test::viewOf(scene, halfCamera(), cameraAt(i)).depth_m, halfCamera(), cameraAt(i),
                                geometry::Matrix6d::Identity() * 1e-6};
      views.push_back({10 * i, i * 1'000'000'000LL, scan});
    }
    return findChangeBoxes(*map_, views, {cornerHome(), {}, carriers, objects}, test::kinectCamera(), {});
  }

  static inline mapping::SeenSpace* map_ = nullptr;
};

CarrierReadings openDoor() {
  registration::JointSpan span;
  span.status = registration::JointStatus::kFound;
  span.last_ns = 100'000'000'000;
  span.value = kOpen_rad;
  CarrierReadings carriers;
  carriers.pieces.push_back({{"cupboard"}, false, {{{"cupboard-door-joint"}, {span}}}});
  return carriers;
}

TEST_F(ChangeBoxes, NothingHasChanged) {
  EXPECT_TRUE(boxes(cornerHome(), false).empty());
}

TEST_F(ChangeBoxes, WhatIsNewHasAPlaceASizeASupportAndAPicture) {
  const std::vector<ChangeBox> found = boxes(cornerHome(), true);
  ASSERT_EQ(found.size(), 1U);
  const mapping::Change& change = found[0].change;
  EXPECT_EQ(change.kind, mapping::ChangeKind::kNew);
  EXPECT_LT((change.center_map - Eigen::Vector3d(0.6, -0.3, 0.175)).norm(), 0.12);
  EXPECT_LT((change.size_m - Eigen::Vector3d(0.4, 0.4, 0.35)).cwiseAbs().maxCoeff(), 0.15);
  EXPECT_TRUE(change.support_height_m);
  EXPECT_EQ(found[0].piece, "");
  EXPECT_EQ(found[0].frame % 10, 0);
  const Eigen::Vector2d middle = test::kinectCamera().project(cameraAt(found[0].frame / 10).inverse() * Eigen::Vector3d(0.6, -0.3, 0.175));
  EXPECT_TRUE(middle.x() > found[0].crop.left && middle.x() < found[0].crop.right) << middle.x();
  EXPECT_TRUE(middle.y() > found[0].crop.top && middle.y() < found[0].crop.bottom) << middle.y();
}

TEST_F(ChangeBoxes, ADoorThatWasReadToBeOpenIsNoChangeAndOneThatWasNotIs) {
  Home open = cornerHome();
  open.rooms[0].objects[0].edit().articulation->joints[0].value = kOpen_rad;
  const auto unread = boxes(open, true);
  EXPECT_TRUE(std::any_of(unread.begin(), unread.end(), [](const ChangeBox& box) { return box.piece == "cupboard"; }));
  const auto read = boxes(open, true, openDoor());
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].piece, "");
}

TEST_F(ChangeBoxes, WhatWasMissedIsNotSaidTwice) {
  Home without = cornerHome();
  without.rooms[0].objects[1].edit().small_objects.clear();
  const auto unmissed = boxes(without, false);
  ASSERT_EQ(unmissed.size(), 1U);
  EXPECT_EQ(unmissed[0].change.kind, mapping::ChangeKind::kGone);
  ObjectReading crate;
  crate.id = {"crate"};
  crate.status = WatchStatus::kMissed;
  EXPECT_TRUE(boxes(without, false, {}, {crate}).empty());
  crate.status = WatchStatus::kHidden;
  EXPECT_EQ(boxes(without, false, {}, {crate}).size(), 1U);
}

}  // namespace
}  // namespace oikos::tracking
