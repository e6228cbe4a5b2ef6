// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/piece_surroundings.h"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>

#include "semantic/model/home_models.h"
#include "tracking/furniture/changed_pieces.h"

namespace oikos::tracking {
namespace {

/// A cupboard before the wall y = 2, a chest of drawers two metres beside it, and a door in the wall x = 3.
semantic::Home homeOf() {
  const auto piece = [](const std::string& id, const std::string& shape, double x, double y, double yaw_deg) {
    semantic::LargeObject object;
    object.id = {id};
    object.shape = semantic::Shape{shape, {}};
    object.articulation = semantic::articulationOf(semantic::makeShape(*object.shape, id), object.id);
    object.T_map_object = {{x, y, 0.0}, {0.0, 0.0, yaw_deg * std::numbers::pi / 180.0}};
    return object;
  };
  semantic::Room room;
  room.outline_map = {{-3.0, -2.0}, {3.0, -2.0}, {3.0, 2.0}, {-3.0, 2.0}};
  room.objects.emplace_back(piece("cupboard", "cabinet", 0.0, 1.6, -90.0));
  room.objects.emplace_back(piece("chest", "drawer_unit", -1.2, 1.6, -90.0));
  room.objects.emplace_back(piece("door", "room_door", 3.0, 0.0, 180.0));
  semantic::Home home;
  home.rooms.push_back(room);
  return home;
}

/// Depth along the axis of a camera at the origin, 1.2 m high, that looks in this direction.
double depthTowards(const render::Scene& scene, double yaw_deg) {
  const camera::PinholeCamera camera{41, 31, 40.0, 40.0, 20.0, 15.0};
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  const double yaw_rad = yaw_deg * std::numbers::pi / 180.0;
  T_map_camera.linear().col(2) = Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
  T_map_camera.linear().col(1) = -Eigen::Vector3d::UnitZ();
  T_map_camera.linear().col(0) = T_map_camera.linear().col(1).cross(T_map_camera.linear().col(2));
  T_map_camera.translation().z() = 0.5;
  const registration::Scan nothing{camera, std::vector<registration::ScanPoint>(static_cast<std::size_t>(camera.width * camera.height))};
  const registration::Surroundings view = surroundingsIn(scene, nothing, T_map_camera);
  return static_cast<double>(view.depth_m.at<float>(15, 20));
}

TEST(HomeSurroundings, OfACupboardAreItsWallAndItsNeighbourWithoutItself) {
  const semantic::Home home = homeOf();
  const std::vector<ArticulatedPiece> pieces = articulatedPieces(home, {});
  ASSERT_EQ(pieces.size(), 3U);
  const HomeSurroundings surroundings(home, {});
  EXPECT_NEAR(depthTowards(surroundings.sceneWithout(pieces[0]), 90.0), 2.0, 1e-5);  // the wall, as if the cupboard were not there
  EXPECT_LT(depthTowards(surroundings.sceneWithout(pieces[1]), 90.0), 1.6);          // of the chest: the cupboard's front
}

TEST(HomeSurroundings, ADoorHasNoWallInItsOpening) {
  const semantic::Home home = homeOf();
  const HomeSurroundings surroundings(home, {});
  EXPECT_TRUE(std::isnan(depthTowards(surroundings.sceneWithout(articulatedPieces(home, {})[2]), 0.0)));
}

TEST(HomeSurroundings, ADoorThatIsThoughtToStandInAWallTakesNothingAwayFromIt) {
  semantic::Home home = homeOf();
  semantic::LargeObject& cupboard = home.rooms[0].objects[0].edit();
  const double half_m = 0.5 * boxOf(articulatedPieces(home, {})[0].model, {semantic::jointValues(cupboard)}).sizes().y();
  cupboard.T_map_object.position_m.x() = half_m - 2.95;  // its left side, with the hinge, stands before the wall x = -3
  for (semantic::Joint& joint : cupboard.articulation->joints) {
    joint.value = joint.upper;
  }
  const ArticulatedPiece piece = articulatedPieces(home, {})[0];
  ASSERT_LT((piece.believed.T_map_model * piece.box_model.min()).x(), -3.05);
  EXPECT_NEAR(depthTowards(HomeSurroundings(home, {}).sceneWithout(piece), 180.0), 3.0, 1e-5);
}

}  // namespace
}  // namespace oikos::tracking
