// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/true_home.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "core/base/number_text.h"
#include "semantic/model/home_check.h"
#include "semantic/model/home_models.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"
#include "tests/tools/simulate/small_home.h"
#include "tests/tools/simulate/statistics.h"

namespace oikos::simulate {
namespace {

using semantic::kRadPerDeg;

BeliefSettings everythingOff() {
  BeliefSettings belief;
  belief.dimension_m = 0.005;
  belief.placement_m = 0.01;
  belief.placement_deg = 0.5;
  belief.axis_m = 0.004;
  belief.axis_deg = 0.4;
  belief.wall_deg = 0.6;
  return belief;
}

double dimensionOf(const semantic::LargeObject& object, const std::string& name) {
  for (const semantic::Property& dimension : (*object.shape)->dimensions) {
    if (dimension.name == name) {
      return base::findNumber(dimension.value).value();
    }
  }
  throw std::runtime_error("no dimension " + name);
}

TEST(TrueHome, WithoutDeviationsIsTheBelievedOne) {
  EXPECT_EQ(makeTrueHome(smallHome(), BeliefSettings(), 1), smallHome());
}

TEST(TrueHome, ComesFromItsSeed) {
  const semantic::Home home = makeTrueHome(smallHome(), everythingOff(), 3);
  EXPECT_EQ(home, makeTrueHome(smallHome(), everythingOff(), 3));
  EXPECT_FALSE(home == makeTrueHome(smallHome(), everythingOff(), 4));
}

TEST(TrueHome, DimensionsAndPlacesHaveTheirDeviations) {
  semantic::Home believed = smallHome();
  for (semantic::Room& room : believed.rooms) {
    room.outline_map.clear();  // walls would hold what stands beside them
  }
  std::vector<double> dimensions_m;
  std::vector<double> places_m;
  std::vector<double> turns_rad;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const semantic::Home home = makeTrueHome(believed, everythingOff(), seed);
    for (const char* id : {"table", "oven", "drawers", "block"}) {
      const semantic::LargeObject& was = pieceOf(believed, id);
      const semantic::LargeObject& is = pieceOf(home, id);
      for (const char* name : {"width_m", "depth_m", "height_m"}) {
        dimensions_m.push_back(dimensionOf(is, name) - dimensionOf(was, name));
      }
      places_m.push_back(is.T_map_object.position_m.x() - was.T_map_object.position_m.x());
      places_m.push_back(is.T_map_object.position_m.y() - was.T_map_object.position_m.y());
      EXPECT_EQ(is.T_map_object.position_m.z(), was.T_map_object.position_m.z());
      turns_rad.push_back(is.T_map_object.roll_pitch_yaw_rad.z() - was.T_map_object.roll_pitch_yaw_rad.z());
    }
  }
  expectGaussianSample(dimensions_m, 0.005);
  expectGaussianSample(places_m, 0.01);
  expectGaussianSample(turns_rad, 0.5 * kRadPerDeg);
}

TEST(TrueHome, AxesHaveTheirDeviations) {
  const semantic::Home believed = smallHome();
  BeliefSettings belief;
  belief.axis_m = 0.004;
  belief.axis_deg = 0.4;
  std::vector<double> shifts_m;
  std::vector<double> turns_rad;
  constexpr int kSeeds = 1000;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const semantic::Home home = makeTrueHome(believed, belief, seed);
    const Eigen::Isometry3d T = jointOf(believed, "oven-door-joint").T_parent_joint.toIsometry().inverse() *
                                jointOf(home, "oven-door-joint").T_parent_joint.toIsometry();
    const Eigen::AngleAxisd turn(T.linear());
    for (int i = 0; i < 3; ++i) {
      shifts_m.push_back(T.translation()[i]);
      turns_rad.push_back(turn.angle() * turn.axis()[i] * std::sqrt(3.0));
    }
  }
  expectGaussianSample(shifts_m, 0.004);
  expectGaussianSample(turns_rad, 0.4 * kRadPerDeg, kSeeds);
}

TEST(TrueHome, JointsFollowTheDimensionsOfTheirShape) {
  BeliefSettings belief;
  belief.dimension_m = 0.01;
  const semantic::Home believed = smallHome();
  const semantic::Home home = makeTrueHome(believed, belief, 5);
  for (const char* id : {"oven", "drawers"}) {
    const semantic::LargeObject& was = pieceOf(believed, id);
    const semantic::LargeObject& is = pieceOf(home, id);
    // These two shapes have their fronts at half their depth.
    const double front_m = 0.5 * (dimensionOf(is, "depth_m") - dimensionOf(was, "depth_m"));
    EXPECT_GT(std::abs(front_m), 1e-4);
    for (std::size_t i = 0; i < is.articulation->joints.size(); ++i) {
      const auto shift = is.articulation->joints[i].T_parent_joint.position_m - was.articulation->joints[i].T_parent_joint.position_m;
      EXPECT_NEAR(shift.x(), front_m, 1e-9) << is.articulation->joints[i].id.value;
      EXPECT_NEAR(shift.y(), 0.0, 1e-9);
    }
  }
}

TEST(TrueHome, JointsStayWithinTheirLimitsAndInTheirStates) {
  semantic::Home believed = smallHome();
  for (semantic::Room& room : believed.rooms) {
    for (auto& object : room.objects) {
      if (object->articulation) {
        for (semantic::Joint& joint : object.edit().articulation->joints) {
          joint.value = joint.upper;
        }
      }
    }
  }
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const semantic::Home home = makeTrueHome(believed, everythingOff(), seed);
    for (const char* id : {"oven-door-joint", "drawers-drawer_0-joint", "drawers-drawer_1-joint"}) {
      const semantic::Joint& joint = jointOf(home, id);
      EXPECT_EQ(joint.value, jointOf(believed, id).value);
      EXPECT_LE(joint.value, joint.upper);
      EXPECT_GE(joint.value, joint.lower);
    }
  }
}

TEST(TrueHome, WhatStandsOnTopStandsOnTheTrueTop) {
  BeliefSettings belief;
  belief.dimension_m = 0.01;
  const semantic::Home home = makeTrueHome(smallHome(), belief, 2);
  EXPECT_NEAR(findSmall(home, "cup")->T_parent_object.position_m.z(), dimensionOf(pieceOf(home, "table"), "height_m"), 1e-12);
}

TEST(TrueHome, WrittenItIsAValidHome) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const semantic::Home home = makeTrueHome(smallHome(), everythingOff(), seed);
    const semantic::HomeReading reading = semantic::readHomeText(semantic::toXml(home), "true home");
    for (const semantic::Finding& finding : reading.findings) {
      EXPECT_NE(finding.severity, semantic::Severity::kError) << finding.element << ": " << finding.found;
    }
    ASSERT_TRUE(reading.complete);
    EXPECT_LT(
        (jointOf(reading.home, "oven-door-joint").T_parent_joint.position_m - jointOf(home, "oven-door-joint").T_parent_joint.position_m)
            .norm(),
        1e-15);
  }
}

double directionOf(const std::vector<Eigen::Vector2d>& outline, std::size_t wall) {
  const Eigen::Vector2d along = outline[(wall + 1) % outline.size()] - outline[wall];
  return std::atan2(along.y(), along.x());
}

TEST(TrueHome, WallsTurnAboutTheirMiddles) {
  BeliefSettings belief;
  belief.wall_deg = 0.6;
  const semantic::Home believed = smallHome();
  std::vector<double> turns_rad;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const semantic::Home home = makeTrueHome(believed, belief, seed);
    for (std::size_t r = 0; r < 2; ++r) {
      const auto& was = believed.rooms[r].outline_map;
      const auto& is = home.rooms[r].outline_map;
      ASSERT_EQ(is.size(), 4U);
      for (std::size_t i = 0; i < 4; ++i) {
        turns_rad.push_back(std::remainder(directionOf(is, i) - directionOf(was, i), 2.0 * std::numbers::pi));
        // The old middle is still on the wall's line.
        const Eigen::Vector2d middle = 0.5 * (was[i] + was[(i + 1) % 4]) - is[i];
        const Eigen::Vector2d along = (is[(i + 1) % 4] - is[i]).normalized();
        EXPECT_NEAR(along.x() * middle.y() - along.y() * middle.x(), 0.0, 1e-9);
      }
    }
  }
  expectGaussianSample(turns_rad, 0.6 * kRadPerDeg);
}

/// How far a point lies from a room's wall, into the room; the outline runs counter-clockwise.
double besideWall(const std::vector<Eigen::Vector2d>& outline, std::size_t wall, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = (outline[(wall + 1) % outline.size()] - outline[wall]).normalized();
  const Eigen::Vector2d from = point - outline[wall];
  return along.x() * from.y() - along.y() * from.x();
}

/// A home of two rooms with a wall of 12 cm between them, a door in it, and a picture and a shelf on it.
semantic::Home homeWithDoor() {
  return semantic::getHome(semantic::readHomeText(R"(<apartment id="a" name="a" version="1">
    <room id="east" name="east" outline_m="0.06 -2 4 -2 4 2 0.06 2">
      <largeArticulatedObject id="door" type="door" pose="0 1 0 0 0 0" movability="fixed" graspable="false">
        <shape kind="room_door"/><part id="door-body"/><part id="door-door" parent="door-body"/>
        <joint id="door-door-joint" type="revolute" parent="door-body" child="door-door" origin="0.07 -0.446 1.007 0 0 0" axis="0 0 -1"
          lower_deg="0" upper_deg="110" value_deg="0"/>
        <parkingPose pose="1 0 0 0 0 180" default="true"/>
      </largeArticulatedObject>
      <largeObject id="picture" type="picture" pose="0.07 -1.4 1.4 0 0 0" movability="fixed" graspable="false">
        <shape kind="box" width_m="0.6" depth_m="0.02" height_m="0.45"/>
        <parkingPose pose="1 0 0 0 0 180" default="true"/></largeObject>
      <largeObject id="block" type="shelf" pose="0.26 -0.5 0 0 0 0" movability="shiftable" graspable="false">
        <shape kind="box" width_m="0.8" depth_m="0.4" height_m="0.9"/>
        <parkingPose pose="1 0 0 0 0 180" default="true"/></largeObject>
    </room>
    <room id="west" name="west" outline_m="-4 -2 -0.06 -2 -0.06 2 -4 2"/>
  </apartment>)",
                                                  "home.xml"),
                           "home.xml");
}

TEST(TrueHome, WhatStandsInOrAgainstAWallFollowsIt) {
  const semantic::Home believed = homeWithDoor();
  BeliefSettings belief = everythingOff();
  belief.wall_deg = 2.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const semantic::Home home = makeTrueHome(believed, belief, seed);
    const auto& east = home.rooms[0].outline_map;  // its wall 3 is the one between the rooms
    const auto& west = home.rooms[1].outline_map;  // here it is wall 1
    const Eigen::Vector2d door = pieceOf(home, "door").T_map_object.position_m.head<2>();
    EXPECT_NEAR(besideWall(east, 3, door), besideWall(west, 1, door), 3e-3) << seed;  // in the middle between the two
    const auto cornersOf = [&](const char* id, double depth_m) {
      const semantic::LargeObject& piece = pieceOf(home, id);
      const Eigen::Isometry3d T = piece.T_map_object.toIsometry();
      const double half_m = 0.5 * dimensionOf(piece, "width_m");
      return std::array{besideWall(east, 3, (T * Eigen::Vector3d(-0.5 * depth_m, half_m, 0.0)).head<2>()),
                        besideWall(east, 3, (T * Eigen::Vector3d(-0.5 * depth_m, -half_m, 0.0)).head<2>())};
    };
    for (const double gap_m : cornersOf("picture", dimensionOf(pieceOf(home, "picture"), "depth_m"))) {
      EXPECT_GT(gap_m, -1e-6) << seed;  // meshes are single precision
      EXPECT_LT(gap_m, 0.02) << seed;   // its depth is 5 mm off, four deviations
    }
    for (const double gap_m : cornersOf("block", dimensionOf(pieceOf(home, "block"), "depth_m"))) {
      EXPECT_GT(gap_m, -1e-6) << seed;  // meshes are single precision
      EXPECT_LT(gap_m, 0.08) << seed;
    }
  }
}

TEST(TrueHome, ACornerWithinAStraightWallStays) {
  BeliefSettings belief;
  belief.wall_deg = 0.6;
  semantic::Home believed = smallHome();
  believed.rooms[0].outline_map.insert(believed.rooms[0].outline_map.begin() + 1, Eigen::Vector2d(0.3, -1.5));
  const semantic::Home home = makeTrueHome(believed, belief, 1);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT((home.rooms[0].outline_map[i] - believed.rooms[0].outline_map[i]).norm(), 0.1) << i;
  }
}

}  // namespace
}  // namespace oikos::simulate
