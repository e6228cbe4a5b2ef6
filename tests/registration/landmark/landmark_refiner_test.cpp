// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/landmark_refiner.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tests/registration/landmark/landmark_room.h"
#include "tests/support/analytic_room.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"

namespace oikos::registration {
namespace {

TEST(LandmarkRefiner, CorrectsTheCameraFromAGridOfStarts) {
  const Room room;
  LandmarkScene scene = room.believed();
  const Scan scan = room.scan();
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double yaw : {-6.0, 0.0, 6.0}) {
        const LandmarkRefinement result = refineByLandmarks(scene, scan, priorOff(room.T_map_camera, x, y, yaw), {});
        ASSERT_EQ(result.status, RefinementStatus::kRefined) << x << " " << y << " " << yaw;
        const PoseError error = between(result.T_map_camera, room.T_map_camera);
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
      const PoseError error = between(result.T_map_camera, room.T_map_camera);
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
        const PoseError error = between(result.T_map_camera, room.T_map_camera);
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
