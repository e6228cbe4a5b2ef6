// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/landmark_refiner.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/model/primitives.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/analytic_room.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"

namespace oikos::registration {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Eigen::Isometry3d onFloor(double x, double y, double yaw_deg) {
  return Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
}

std::shared_ptr<const model::TriangleMesh> box(const Eigen::Vector3f& size_m) {
  return std::make_shared<const model::TriangleMesh>(model::makeBox(size_m));
}

struct Piece {
  std::string id;
  test::FurnitureKind furniture;
  Eigen::Isometry3d T_map_model;
  std::vector<double> joint_values = {};  ///< empty: closed
};

/// Pieces in a room, as they really stand; and the camera before them, looking along y.
struct Room {
  std::vector<Piece> pieces = {{"fridge", {"fridge"}, onFloor(-1.0, 3.0, -90.0)},
                               {"cabinet", {"cabinet"}, onFloor(-0.1, 3.0, -90.0)},
                               {"drawers", {"drawer_unit"}, onFloor(0.8, 3.0, -90.0)},
                               {"shelf", {"shelf"}, onFloor(1.5, 1.9, -170.0)},
                               {"oven", {"oven"}, onFloor(-1.6, 1.9, 0.0)}};
  Eigen::Isometry3d T_map_camera = test::lookAt({0.0, -0.8, 1.2}, {0.0, 3.0, 0.7});
  std::vector<Eigen::Isometry3d> people = {};  ///< T_map_person
  std::vector<Eigen::Isometry3d> boxes = {};   ///< T_map_box, of what stands about: 12 cm wide and deep, 25 cm high
  camera::DepthSensorKind sensor = camera::DepthSensorKind::kIdeal;

  [[nodiscard]] Piece& piece(const std::string& id) {
    return *std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.id == id; });
  }

  [[nodiscard]] Scan scan() const {
    render::Scene world;
    for (const Piece& p : pieces) {
      const model::ArticulatedModel model = test::believed(p.furniture);
      world.add(model, p.T_map_model, valuesOf(p, model));
    }
    world.add(box({8.0F, 8.0F, 0.1F}), Eigen::Isometry3d(Eigen::Translation3d(0.0, 2.0, -0.05)));
    world.add(box({8.0F, 0.1F, 3.0F}), Eigen::Isometry3d(Eigen::Translation3d(0.0, 3.6, 1.5)));
    for (const Eigen::Isometry3d& T_map_person : people) {
      world.add(box({0.45F, 0.3F, 1.75F}), T_map_person * Eigen::Translation3d(0.0, 0.0, 0.875));
    }
    for (const Eigen::Isometry3d& T_map_box : boxes) {
      world.add(box({0.12F, 0.12F, 0.25F}), T_map_box * Eigen::Translation3d(0.0, 0.0, 0.125));
    }
    world.commit();
    const camera::PinholeCamera camera = test::kinectCamera();
    return makeScan(test::sensed(test::viewOf(world, camera, T_map_camera), camera, sensor, 1), camera, {});
  }

  /// As it is believed: call before anything is moved.
  [[nodiscard]] LandmarkScene believed() const {
    LandmarkScene scene;
    for (const Piece& p : pieces) {
      const model::ArticulatedModel model = test::believed(p.furniture);
      scene.add(p.id, model, p.T_map_model, valuesOf(p, model));
    }
    return scene;
  }

  static std::vector<double> valuesOf(const Piece& p, const model::ArticulatedModel& model) {
    return p.joint_values.empty() ? std::vector<double>(model.joints.size(), 0.0) : p.joint_values;
  }
};

/// The camera where it is thought to be: the robot, 10 cm behind it, is elsewhere.
CameraPrior priorOff(const Eigen::Isometry3d& T_map_camera, double x_m, double y_m, double yaw_deg) {
  CameraPrior prior;
  prior.robot_camera = {0.0, 0.0, -0.1};
  Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
  twist << x_m, y_m, 0.0, 0.0, 0.0, yaw_deg * kDegree;
  prior.T_map_camera = motionAbout(T_map_camera * prior.robot_camera, twist) * T_map_camera;
  return prior;
}

struct Error {
  double metres;
  double degrees;
};
Error between(const Eigen::Isometry3d& T_map_a, const Eigen::Isometry3d& T_map_b) {
  const Eigen::Isometry3d T_a_b = T_map_a.inverse() * T_map_b;
  return {T_a_b.translation().norm(), Eigen::AngleAxisd(T_a_b.linear()).angle() / kDegree};
}

const LandmarkContribution* find(const LandmarkRefinement& result, const std::string& id) {
  const auto found = std::find_if(result.landmarks.begin(), result.landmarks.end(), [&](const auto& piece) { return piece.id == id; });
  return found == result.landmarks.end() ? nullptr : &*found;
}
LandmarkVerdict verdictOf(const LandmarkRefinement& result, const std::string& id) {
  const LandmarkContribution* piece = find(result, id);
  EXPECT_NE(piece, nullptr) << id;
  return piece == nullptr ? LandmarkVerdict::kHidden : piece->verdict;
}

TEST(LandmarkRefiner, CorrectsTheCameraFromAGridOfStarts) {
  const Room room;
  LandmarkScene scene = room.believed();
  const Scan scan = room.scan();
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double yaw : {-6.0, 0.0, 6.0}) {
        const LandmarkRefinement result = refineByLandmarks(scene, scan, priorOff(room.T_map_camera, x, y, yaw), {});
        ASSERT_EQ(result.status, RefinementStatus::kRefined) << x << " " << y << " " << yaw;
        const Error error = between(result.T_map_camera, room.T_map_camera);
        EXPECT_LT(error.metres, 0.004) << x << " " << y << " " << yaw;
        EXPECT_LT(error.degrees, 0.15) << x << " " << y << " " << yaw;
        EXPECT_GE(result.landmarks.size(), 4U);
        double weight = 0.0;
        for (const LandmarkContribution& piece : result.landmarks) {
          EXPECT_EQ(piece.verdict, LandmarkVerdict::kUsed) << piece.id;
          EXPECT_LE(piece.contradiction, 1.0) << piece.id;
          weight += piece.weight;
        }
        EXPECT_NEAR(weight, 1.0, 1e-9);
        EXPECT_NEAR(result.moved_m, std::hypot(x, y), 0.004);
        EXPECT_NEAR(result.moved_rad, std::abs(yaw) * kDegree, 0.003);
        EXPECT_GT(result.covariance.selfadjointView<Eigen::Upper>().eigenvalues().minCoeff(), 0.0);
      }
    }
  }
}

/// Only x, y and yaw are corrected: height and tilt are the prior's (S216, S219).
TEST(LandmarkRefiner, TheCorrectionIsPlanar) {
  const Room room;
  LandmarkScene scene = room.believed();
  const CameraPrior prior = priorOff(room.T_map_camera, 0.05, -0.04, 3.0);
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), prior, {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  const Eigen::Isometry3d T_before_after_map = result.T_map_camera * prior.T_map_camera.inverse();
  EXPECT_NEAR(T_before_after_map.translation().z(), 0.0, 1e-12);
  EXPECT_LT((T_before_after_map.linear() * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(LandmarkRefiner, AShiftedFridgeIsLeftOut) {
  for (const double shift_m : {0.06, 0.12, 0.4}) {
    Room room;
    LandmarkScene scene = room.believed();
    room.piece("fridge").T_map_model.translation().x() -= shift_m;
    room.sensor = camera::DepthSensorKind::kKinect1;
    const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
    ASSERT_EQ(result.status, RefinementStatus::kRefined) << shift_m;
    EXPECT_EQ(verdictOf(result, "fridge"), LandmarkVerdict::kMoved) << shift_m;
    EXPECT_EQ(verdictOf(result, "cabinet"), LandmarkVerdict::kUsed) << shift_m;
    EXPECT_EQ(verdictOf(result, "drawers"), LandmarkVerdict::kUsed) << shift_m;
    const Error error = between(result.T_map_camera, room.T_map_camera);
    EXPECT_LT(error.metres, 0.015) << shift_m;
    EXPECT_LT(error.degrees, 0.4) << shift_m;
  }
}

/// Pushed to the other side it hides where its side should be: nothing contradicts, and nothing is spoilt.
TEST(LandmarkRefiner, AShiftThatHidesItselfDoesNoHarm) {
  Room room;
  LandmarkScene scene = room.believed();
  room.piece("fridge").T_map_model.translation().x() += 0.12;
  room.sensor = camera::DepthSensorKind::kKinect1;
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  EXPECT_LT(between(result.T_map_camera, room.T_map_camera).metres, 0.015);
}

TEST(LandmarkRefiner, AFridgePulledForwardIsLeftOut) {
  Room room;
  LandmarkScene scene = room.believed();
  room.piece("fridge").T_map_model.translation().y() -= 0.08;
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  EXPECT_NE(verdictOf(result, "fridge"), LandmarkVerdict::kUsed);  // its side is where it was, its doors are not
  EXPECT_LT(between(result.T_map_camera, room.T_map_camera).metres, 0.01);
}

/// Chairs that someone has called fixed.
TEST(LandmarkRefiner, ASwappedPairOfChairsIsLeftOut) {
  Room room;
  const test::FurnitureKind high{"chair", {{"height_m", "1.1"}, {"seat_height_m", "0.6"}}};
  room.pieces.push_back({"chair", {"chair"}, onFloor(-0.5, 1.9, 20.0)});
  room.pieces.push_back({"high-chair", high, onFloor(0.5, 1.9, -50.0)});
  LandmarkScene scene = room.believed();
  std::swap(room.piece("chair").T_map_model, room.piece("high-chair").T_map_model);
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  EXPECT_EQ(verdictOf(result, "chair"), LandmarkVerdict::kMoved);
  EXPECT_EQ(verdictOf(result, "high-chair"), LandmarkVerdict::kMoved);
  EXPECT_EQ(verdictOf(result, "fridge"), LandmarkVerdict::kUsed);
  EXPECT_LT(between(result.T_map_camera, room.T_map_camera).metres, 0.01);
}

TEST(LandmarkRefiner, AnOpenDoorIsLeftOutAndItsCabinetKept) {
  for (const double angle_deg : {20.0, 60.0, 95.0}) {
    Room room;
    LandmarkScene scene = room.believed();
    const model::ArticulatedModel cabinet = test::believed({"cabinet"});
    room.piece("cabinet").joint_values.assign(cabinet.joints.size(), 0.0);
    for (std::size_t j = 0; j < cabinet.joints.size(); ++j) {
      if (cabinet.joints[j].type == model::MotionType::kRevolute && cabinet.joints[j].name.find("door") != std::string::npos) {
        room.piece("cabinet").joint_values[j] = angle_deg * kDegree;
      }
    }
    const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
    ASSERT_EQ(result.status, RefinementStatus::kRefined) << angle_deg;
    EXPECT_NE(verdictOf(result, "cabinet"), LandmarkVerdict::kMoved) << angle_deg;
    ASSERT_NE(find(result, "cabinet"), nullptr);
    EXPECT_FALSE(find(result, "cabinet")->dropped_parts.empty()) << angle_deg;
    EXPECT_LT(between(result.T_map_camera, room.T_map_camera).metres, 0.01) << angle_deg;
  }
}

TEST(LandmarkRefiner, APersonBeforeThemHidesAndDoesNotContradict) {
  for (const double x : {-0.6, 0.0, 0.5}) {
    Room room;
    LandmarkScene scene = room.believed();
    room.people = {onFloor(x, 0.9, 30.0)};
    room.sensor = camera::DepthSensorKind::kKinect1;
    const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
    ASSERT_EQ(result.status, RefinementStatus::kRefined) << x;
    for (const LandmarkContribution& piece : result.landmarks) {
      EXPECT_NE(piece.verdict, LandmarkVerdict::kMoved) << piece.id << " " << x << " contradiction " << piece.contradiction << " pixels "
                                                        << piece.pixels << " agreeing " << piece.agreeing;
    }
    const Error error = between(result.T_map_camera, room.T_map_camera);
    EXPECT_LT(error.metres, 0.015) << x;
    EXPECT_LT(error.degrees, 0.4) << x;
  }
}

/// Books, boxes and chairs hide what is behind them; they are no sign that it has been moved.
TEST(LandmarkRefiner, ClutterBeforeThemDoesNotContradict) {
  Room room;
  LandmarkScene scene = room.believed();
  for (int i = 0; i < 12; ++i) {
    const double along_m = -1.3 + 0.2 * i;
    room.boxes.push_back(Eigen::Translation3d(0.0, 0.0, 0.2 + 0.15 * (i % 4)) * onFloor(along_m, 2.6 - 0.02 * (i % 3), 10.0 * i));
  }
  room.sensor = camera::DepthSensorKind::kKinect1;
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  for (const LandmarkContribution& piece : result.landmarks) {
    EXPECT_NE(piece.verdict, LandmarkVerdict::kMoved) << piece.id << " contradiction " << piece.contradiction;
  }
  const Error error = between(result.T_map_camera, room.T_map_camera);
  EXPECT_LT(error.metres, 0.015);
  EXPECT_LT(error.degrees, 0.4);
}

/// A row of equal cupboards, from a prior that is wider than they are: the end of the row tells which is which.
TEST(LandmarkRefiner, ARowOfEqualFrontsIsNotTakenForItsNeighbour) {
  Room room;
  room.pieces.clear();
  for (int i = 0; i < 4; ++i) {
    room.pieces.push_back({"cabinet-" + std::to_string(i), {"cabinet"}, onFloor(-1.2 + 0.6 * i, 3.0, -90.0)});
  }
  room.sensor = camera::DepthSensorKind::kKinect1;
  LandmarkScene scene = room.believed();
  const Scan scan = room.scan();
  for (const double x : {-0.3, 0.2, 0.3}) {
    for (const double yaw : {-8.0, 8.0}) {
      CameraPrior prior = priorOff(room.T_map_camera, x, 0.05, yaw);
      prior.sigma_m = 0.2;
      prior.sigma_rad = 8.0 * kDegree;
      const LandmarkRefinement result = refineByLandmarks(scene, scan, prior, {});
      ASSERT_EQ(result.status, RefinementStatus::kRefined) << x << " " << yaw;
      const Error error = between(result.T_map_camera, room.T_map_camera);
      EXPECT_LT(error.metres, 0.02) << x << " " << yaw;
      EXPECT_LT(error.degrees, 0.4) << x << " " << yaw;
    }
  }
}

/// The home has one cupboard less than the row: as many fit from where its neighbours stand. Wrong by a cupboard it must not be.
TEST(LandmarkRefiner, ARowThatTheHomeHasOneShorterIsNotWrongByOne) {
  Room room;
  room.pieces.clear();
  for (int i = 0; i < 4; ++i) {
    room.pieces.push_back({"cabinet-" + std::to_string(i), {"cabinet"}, onFloor(-1.2 + 0.6 * i, 3.0, -90.0)});
  }
  room.sensor = camera::DepthSensorKind::kKinect1;
  const Scan scan = room.scan();
  int refined = 0;
  int ambiguous = 0;
  for (const bool first_is_missing : {false, true}) {
    Room shorter = room;
    shorter.pieces.erase(first_is_missing ? shorter.pieces.begin() : shorter.pieces.end() - 1);
    LandmarkScene scene = shorter.believed();
    for (const double x : {-0.4, -0.3, -0.2, 0.0, 0.2, 0.3, 0.4}) {
      for (const double yaw : {-8.0, 8.0}) {
        CameraPrior prior = priorOff(room.T_map_camera, x, 0.05, yaw);
        prior.sigma_m = 0.2;
        prior.sigma_rad = 8.0 * kDegree;
        const LandmarkRefinement result = refineByLandmarks(scene, scan, prior, {});
        const Error error = between(result.T_map_camera, room.T_map_camera);
        const Eigen::Matrix3d covariance_map =
            result.T_map_camera.linear() * result.covariance.topLeftCorner<3, 3>() * result.T_map_camera.linear().transpose();
        refined += result.status == RefinementStatus::kRefined ? 1 : 0;
        ambiguous += result.status == RefinementStatus::kAmbiguous ? 1 : 0;
        if (result.status == RefinementStatus::kRefined) {
          EXPECT_LT(error.metres, 5.0 * std::sqrt(covariance_map(0, 0))) << first_is_missing << " " << x << " " << yaw;
        }
      }
    }
  }
  EXPECT_GT(refined, 0);
  EXPECT_GT(ambiguous, 0);
}

TEST(LandmarkRefiner, WhereMostHasBeenMovedTheAnswerIsRefused) {
  Room room;
  LandmarkScene scene = room.believed();
  room.piece("fridge").T_map_model.translation().x() -= 0.15;
  room.piece("cabinet").T_map_model.translation().y() -= 0.12;
  room.piece("drawers").T_map_model = room.piece("drawers").T_map_model * onFloor(0.05, 0.1, 20.0);
  const CameraPrior prior = priorOff(room.T_map_camera, 0.02, 0.01, 1.0);
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), prior, {});
  EXPECT_EQ(result.status, RefinementStatus::kInconsistent);
  EXPECT_EQ(result.T_map_camera.matrix(), prior.T_map_camera.matrix());
}

/// All pieces agree, but on a place where the robot cannot be.
TEST(LandmarkRefiner, ACorrectionBeyondThePriorIsRefused) {
  Room room;
  LandmarkScene scene = room.believed();
  CameraPrior prior = priorOff(room.T_map_camera, 0.15, 0.0, 0.0);
  prior.sigma_m = 0.01;
  prior.sigma_rad = 0.01;
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), prior, {});
  EXPECT_EQ(result.status, RefinementStatus::kInconsistent);
}

TEST(LandmarkRefiner, OnePieceIsTooFewUnlessItIsAskedFor) {
  Room room;
  room.pieces.erase(room.pieces.begin() + 1, room.pieces.end());
  room.T_map_camera = test::lookAt({0.0, 1.2, 1.2}, {-1.0, 3.0, 0.9});
  LandmarkScene scene = room.believed();
  const CameraPrior prior = priorOff(room.T_map_camera, 0.04, 0.03, 2.0);
  const Scan scan = room.scan();
  EXPECT_EQ(refineByLandmarks(scene, scan, prior, {}).status, RefinementStatus::kTooFewLandmarks);
  const LandmarkRefinement alone = refineByLandmarks(scene, scan, prior, {}, 0);
  ASSERT_EQ(alone.status, RefinementStatus::kRefined);
  EXPECT_LT(between(alone.T_map_camera, room.T_map_camera).metres, 0.02);  // an eighth of the prior's 5 cm, and what the piece hides
  // One piece may stand turned by as much as planes may be, and nothing but the prior tells: its turn is the camera's.
  const LandmarkConfig config;
  const double turn_rad = config.align.normal_sigma_deg * kDegree;
  const double upright_rad = config.upright_sigma_deg * kDegree;
  const double stated_sq = alone.covariance.bottomRightCorner<3, 3>().trace() - 2.0 * upright_rad * upright_rad;
  EXPECT_GT(std::sqrt(stated_sq), 0.8 * turn_rad);
  EXPECT_LT(std::sqrt(stated_sq), 1.1 * turn_rad);
}

/// Of a row of bare fronts only the distance and the heading are seen: along the row the prior answers.
TEST(LandmarkRefiner, WhatIsNotObservedIsThePriors) {
  render::Scene world;
  LandmarkScene scene;
  for (int i = 0; i < 3; ++i) {
    model::ArticulatedModel panel;
    panel.name = "panel";
    panel.parts.push_back({"panel", box({3.0F, 0.02F, 2.8F})});
    const Eigen::Isometry3d T_map_panel(Eigen::Translation3d(3.0 * (i - 1), 2.5, 1.4));
    world.add(panel, T_map_panel, {});
    scene.add("panel-" + std::to_string(i), panel, T_map_panel, {});
  }
  world.commit();
  const Eigen::Isometry3d T_map_camera = test::lookAt({0.0, 0.0, 1.2}, {0.4, 2.5, 1.2});
  const camera::PinholeCamera camera = test::kinectCamera();
  const Scan scan =
      makeScan(test::sensed(test::viewOf(world, camera, T_map_camera), camera, camera::DepthSensorKind::kIdeal, 1), camera, {});
  LandmarkConfig config;
  config.min_landmarks = 1;
  const LandmarkRefinement result = refineByLandmarks(scene, scan, priorOff(T_map_camera, 0.05, 0.05, 2.0), config);
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  EXPECT_EQ(result.unobserved, std::vector<std::string>{"x"});
  const Eigen::Vector3d off_map = result.T_map_camera.translation() - T_map_camera.translation();
  EXPECT_NEAR(off_map.x(), 0.05, 0.015);
  EXPECT_NEAR(off_map.y(), 0.0, 0.005);
  EXPECT_LT(between(result.T_map_camera, T_map_camera).degrees, 0.2);
  const Eigen::Matrix3d covariance_map =
      result.T_map_camera.linear() * result.covariance.topLeftCorner<3, 3>() * result.T_map_camera.linear().transpose();
  EXPECT_NEAR(std::sqrt(covariance_map(0, 0)), 0.05, 0.01);
  EXPECT_LT(std::sqrt(covariance_map(1, 1)), 0.015);
}

TEST(LandmarkRefiner, NothingInViewAndNoReadingsAreTooFew) {
  const Room room;
  LandmarkScene scene = room.believed();
  const CameraPrior prior = priorOff(room.T_map_camera, 0.0, 0.0, 0.0);
  const camera::PinholeCamera camera = test::kinectCamera();
  const cv::Mat dark(camera.height, camera.width, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  const LandmarkRefinement blind = refineByLandmarks(scene, makeScan(dark, camera, {}), prior, {});
  EXPECT_EQ(blind.status, RefinementStatus::kTooFewLandmarks);
  EXPECT_TRUE(blind.landmarks.empty());
  CameraPrior away = prior;
  away.T_map_camera = test::lookAt({0.0, 0.2, 1.2}, {0.0, -3.0, 1.2});
  EXPECT_EQ(refineByLandmarks(scene, room.scan(), away, {}).status, RefinementStatus::kTooFewLandmarks);
  LandmarkScene empty;
  EXPECT_EQ(refineByLandmarks(empty, room.scan(), prior, {}).status, RefinementStatus::kTooFewLandmarks);
}

TEST(LandmarkRefiner, TheSameForAnyNumberOfThreads) {
  Room room;
  room.sensor = camera::DepthSensorKind::kKinect1;
  LandmarkScene scene = room.believed();
  const CameraPrior prior = priorOff(room.T_map_camera, 0.05, 0.02, -3.0);
  const Scan scan = room.scan();
  LandmarkConfig many;
  many.align.threads = 3;
  const LandmarkRefinement one = refineByLandmarks(scene, scan, prior, {});
  const LandmarkRefinement three = refineByLandmarks(scene, scan, prior, many);
  EXPECT_EQ(one.T_map_camera.matrix(), three.T_map_camera.matrix());
  EXPECT_EQ(one.covariance, three.covariance);
}

TEST(LandmarkRefiner, EnumsHaveNames) {
  test::checkEnumTable(RefinementStatus::kRefined);
  test::checkEnumTable(LandmarkVerdict::kMoved);
}

TEST(LandmarkConfig, RulesAreChecked) {
  EXPECT_TRUE(base::validateConfig(LandmarkConfig{}).empty());
  LandmarkConfig config;
  config.min_landmarks = 0;
  config.check.chance = 0.0;
  EXPECT_EQ(base::validateConfig(config),
            (std::vector<std::string>{"min_landmarks = 0: must be >= 1", "check.chance = 0: must be > 0 and < 0.5"}));
}

}  // namespace
}  // namespace oikos::registration
