// SPDX-License-Identifier: Apache-2.0
// A table before a simulated Kinect, its dimensions off as a tape's are, that stands elsewhere than the home has it.
#include "tracking/furniture/moved_furniture.h"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <string>

#include "semantic/xml/home_reader.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/temporary_folder.h"
#include "tracking/furniture/changed_pieces.h"

namespace oikos::tracking {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A room with a table, a door of which nothing moves but the leaf, and a chair.
semantic::Home homeWith(const std::string& movability) {
  const test::TemporaryFolder folder;
  const auto piece = [](const std::string& id, const std::string& type, const std::string& pose, const std::string& movability_of,
                        const std::string& shape) {
    return "<largeObject id=\"" + id + "\" type=\"" + type + "\" pose=\"" + pose + "\" movability=\"" + movability_of +
           "\" graspable=\"false\">" + shape + "<parkingPose pose=\"1 0 0 0 0 180\" default=\"true\"/></largeObject>";
  };
  const auto file = folder.write(
      "home.xml", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<apartment id=\"a\" name=\"A\" version=\"1\"><room id=\"r\" name=\"R\">" +
                      piece("table", "table", "0.3 0.6 0 0 0 90", movability, "<shape kind=\"table\"/>") +
                      piece("chair", "chair", "3 3 0 0 0 0", "movable", "<shape kind=\"chair\"/>") + "</room></apartment>");
  return semantic::getHome(semantic::readHome(file), file);
}

const Eigen::Isometry3d kBelieved = Eigen::Translation3d(0.3, 0.6, 0.0) * Eigen::AngleAxisd(90.0 * kDegree, Eigen::Vector3d::UnitZ());

/// Images of the table at this place from several sides, halved in size as a revision's.
std::vector<mapping::LocatedScan> scansOf(const Eigen::Isometry3d& T_map_table,
                                          const std::vector<double>& off_axis_all_deg = {-60.0, 20.0, 55.0}) {
  std::mt19937_64 random(5);
  const model::ArticulatedModel real = test::trulyBuilt({"table"}, 0.005, random);
  std::vector<mapping::LocatedScan> scans;
  for (const double off_axis_deg : off_axis_all_deg) {
    test::FurnitureScene world;
    world.model = &real;
    world.joint_values.assign(real.joints.size(), 0.0);
    world.T_map_model = T_map_table;
    world.T_map_camera = test::cameraBefore(T_map_table, 2.0, off_axis_deg * kDegree, 0.6);
    world.noise_seed = static_cast<std::uint64_t>(100.0 + off_axis_deg);
    const camera::PinholeCamera camera = test::kinectCamera();
    const cv::Mat depth_m = test::recordDepth(world, camera);
    mapping::LocatedScan scan;
    scan.camera = {camera.width / 2, camera.height / 2, camera.fx / 2.0, camera.fy / 2.0, camera.cx / 2.0, camera.cy / 2.0};
    scan.depth_m = cv::Mat(scan.camera.height, scan.camera.width, CV_32FC1);
    for (int v = 0; v < scan.camera.height; ++v) {
      for (int u = 0; u < scan.camera.width; ++u) {
        scan.depth_m.at<float>(v, u) = depth_m.at<float>(2 * v, 2 * u);
      }
    }
    scan.T_map_camera = world.T_map_camera;
    scans.push_back(scan);
  }
  return scans;
}

void expectFound(const std::vector<MovedPiece>& moved, const Eigen::Isometry3d& T_map_table) {
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].id.value, "table");
  EXPECT_GE(moved[0].views, 2);
  const Eigen::Isometry3d T_true_found = T_map_table.inverse() * moved[0].T_map_after;
  EXPECT_LT(T_true_found.translation().norm(), 0.03);
  EXPECT_LT(Eigen::AngleAxisd(T_true_found.linear()).angle(), 2.0 * kDegree);
  EXPECT_LT((moved[0].T_map_before.translation() - kBelieved.translation()).norm(), 1e-9);
}

TEST(MovedFurniture, AShiftedTableIsFoundWhereItStands) {
  const Eigen::Isometry3d T_map_table =
      kBelieved * Eigen::Translation3d(0.18, -0.12, 0.0) * Eigen::AngleAxisd(9.0 * kDegree, Eigen::Vector3d::UnitZ());
  expectFound(findMovedFurniture(homeWith("shiftable"), {}, scansOf(T_map_table), {}, {}), T_map_table);
}

/// Something stands before a part of it, so that no view tells it by itself, and the robot went past hardly to the side.
TEST(MovedFurniture, TwoViewsNearToEachOtherFindATableThatIsPartlyHidden) {
  const Eigen::Isometry3d T_map_table =
      kBelieved * Eigen::Translation3d(0.18, -0.12, 0.0) * Eigen::AngleAxisd(9.0 * kDegree, Eigen::Vector3d::UnitZ());
  std::vector<mapping::LocatedScan> scans = scansOf(T_map_table, {24.0, 32.0});
  for (mapping::LocatedScan& scan : scans) {
    scan.depth_m.colRange(135, 175).setTo(1.0F);
  }
  EXPECT_TRUE(findMovedFurniture(homeWith("shiftable"), {}, {scans.front()}, {}, {}).empty());
  expectFound(findMovedFurniture(homeWith("shiftable"), {}, scans, {}, {}), T_map_table);
  MovedFurnitureConfig far_apart;
  far_apart.view_apart_deg = 12.0;
  EXPECT_TRUE(findMovedFurniture(homeWith("shiftable"), {}, scans, {}, far_apart).empty());
}

TEST(MovedFurniture, ATableThatWasCarriedAwayIsFoundWhereSomethingIsNew) {
  const Eigen::Isometry3d T_map_table = Eigen::Translation3d(-1.4, 2.3, 0.0) * Eigen::AngleAxisd(185.0 * kDegree, Eigen::Vector3d::UnitZ());
  const std::vector<mapping::LocatedScan> scans = scansOf(T_map_table);
  EXPECT_TRUE(findMovedFurniture(homeWith("shiftable"), {}, scans, {}, {}).empty());
  mapping::Change change;
  change.kind = mapping::ChangeKind::kNew;
  change.center_map = T_map_table.translation() + Eigen::Vector3d(0.05, -0.04, 0.37);
  change.size_m = {1.2, 0.8, 0.74};
  expectFound(findMovedFurniture(homeWith("shiftable"), {}, scans, {change}, {}), T_map_table);
}

TEST(MovedFurniture, WhatStandsWhereItIsBelievedHasNotMoved) {
  EXPECT_TRUE(findMovedFurniture(homeWith("shiftable"), {}, scansOf(kBelieved * Eigen::Translation3d(0.01, 0.008, 0.0)), {}, {}).empty());
}

TEST(MovedFurniture, OnlyShiftablePiecesAreLookedFor) {
  const std::vector<mapping::LocatedScan> scans = scansOf(kBelieved * Eigen::Translation3d(0.18, -0.12, 0.0));
  EXPECT_TRUE(findMovedFurniture(homeWith("fixed"), {}, scans, {}, {}).empty());
  EXPECT_TRUE(findMovedFurniture(homeWith("movable"), {}, scans, {}, {}).empty());
  EXPECT_TRUE(findMovedFurniture(homeWith("shiftable"), {}, {}, {}, {}).empty());
}

TEST(MovedFurniture, TheSameForAnyNumberOfThreads) {
  const std::vector<mapping::LocatedScan> scans = scansOf(kBelieved * Eigen::Translation3d(0.18, -0.12, 0.0));
  MovedFurnitureConfig three;
  three.threads = 3;
  const auto a = findMovedFurniture(homeWith("shiftable"), {}, scans, {}, {});
  const auto b = findMovedFurniture(homeWith("shiftable"), {}, scans, {}, three);
  ASSERT_EQ(a.size(), 1U);
  ASSERT_EQ(b.size(), 1U);
  EXPECT_EQ(a[0].T_map_after.matrix(), b[0].T_map_after.matrix());
}

TEST(MovedFurniture, RulesAreChecked) {
  MovedFurnitureConfig config;
  EXPECT_TRUE(config.validate().empty());
  config.views = 0;
  config.min_fit = 1.5;
  EXPECT_EQ(config.validate(), (std::vector<std::string>{"views = 0: must be >= 1", "min_fit = 1.5: must be from 0 to 1"}));
}

mapping::Change boxAt(const Eigen::Vector3d& center_map, const Eigen::Vector3d& size_m) {
  mapping::Change change;
  change.center_map = center_map;
  change.size_m = size_m;
  return change;
}

TEST(ChangedPieces, AChangeIsOfThePieceThatHoldsIt) {
  const semantic::Home home = homeWith("shiftable");
  const std::vector<std::string> pieces = piecesOf({boxAt({0.3, 0.6, 0.7}, {0.3, 0.3, 0.1}), boxAt({3.0, 3.0, 0.3}, {0.3, 0.3, 0.4}),
                                                    boxAt({-3.0, 0.0, 1.0}, {0.5, 0.5, 0.5}), boxAt({0.3, 0.6, 1.5}, {0.3, 0.3, 0.3})},
                                                   home, {});
  EXPECT_EQ(pieces, (std::vector<std::string>{"table", "chair", "", ""}));
  EXPECT_TRUE(piecesOf({}, home, {}).empty());
}

/// The demo home's kitchen door: its leaf in the hall or in the kitchen is the door's, and nothing of the wall is.
TEST(ChangedPieces, AnOpenedLeafIsOfItsDoor) {
  const std::filesystem::path demo = std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/demo";
  const semantic::Home home = semantic::getHome(semantic::readHome(demo / "home.xml"), demo / "home.xml");
  const std::vector<std::string> closed_and_open = piecesOf(
      {boxAt({1.4, 0.96, 1.0}, {0.7, 0.1, 1.8}), boxAt({0.94, 1.35, 1.0}, {0.1, 0.6, 1.8}), boxAt({1.86, 1.35, 1.0}, {0.1, 0.6, 1.8}),
       boxAt({0.94, 0.55, 1.0}, {0.1, 0.6, 1.8}), boxAt({1.86, 0.55, 1.0}, {0.1, 0.6, 1.8})},
      home, demo);
  EXPECT_EQ(closed_and_open[0], "kitchen-door");
  EXPECT_EQ(std::count(closed_and_open.begin(), closed_and_open.end(), "kitchen-door"), 3);  // the leaf swings to one side of the wall
}

}  // namespace
}  // namespace oikos::tracking
