// SPDX-License-Identifier: Apache-2.0
#include "registration/pose_search.h"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>

#include "core/model/primitives.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/config_rules_check.h"

namespace oikos::registration {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// One trial from the edge of the range that is promised.
struct Found {
  AlignResult result;
  double error_m;
  double error_rad;
};

Found searchFrom(const test::FurnitureKind& furniture, const Eigen::Isometry3d& T_model_start, bool has_occluder = false,
                 double distance_m = 2.0, double off_axis_deg = 45.0) {
  std::mt19937_64 random(11);
  const model::ArticulatedModel real = test::trulyBuilt(furniture, 0.005, random);
  const model::ArticulatedModel model = test::believed(furniture);
  test::FurnitureScene world;
  world.model = &real;
  world.joint_values.assign(real.joints.size(), 0.0);
  world.T_map_model = Eigen::Translation3d(0.3, 0.6, 0.0) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ());
  world.T_map_camera = test::cameraBefore(world.T_map_model, distance_m, off_axis_deg * kDegree, 0.6);
  world.has_occluder = has_occluder;
  const Eigen::Isometry3d T_map_start = world.T_map_model * T_model_start;
  render::Scene scene;
  const int piece = scene.add(model, T_map_start, world.joint_values);
  ModelMotion motion(scene, piece, model, world.T_map_camera, {T_map_start, world.joint_values}, {});
  Found found;
  found.result = searchPose(motion, makeScan(test::recordDepth(world, test::kinectCamera()), test::kinectCamera(), {}), {});
  const Eigen::Isometry3d T_true_found = world.T_map_model.inverse() * motion.pose().T_map_model;
  found.error_m = T_true_found.translation().norm();
  found.error_rad = Eigen::AngleAxisd(T_true_found.linear()).angle();
  return found;
}

TEST(PoseSearch, FindsFurnitureFromTheCornersOfItsRange) {
  for (const char* kind : {"cabinet", "table", "shelf"}) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Isometry3d T_model_start =
          Eigen::Translation3d(side * 0.28, 0.25, 0.0) * Eigen::AngleAxisd(-side * 14.0 * kDegree, Eigen::Vector3d::UnitZ());
      const Found found = searchFrom({kind}, T_model_start);
      EXPECT_EQ(found.result.status, AlignStatus::kConverged) << kind << side;
      EXPECT_LT(found.error_m, 0.015) << kind << side;
      EXPECT_LT(found.error_rad, 0.6 * kDegree) << kind << side;
    }
  }
}

TEST(PoseSearch, APersonBeforeTheFurnitureDoesNotPullIt) {
  const Found found =
      searchFrom({"sofa"}, Eigen::Translation3d(0.1, -0.1, 0.0) * Eigen::AngleAxisd(5.0 * kDegree, Eigen::Vector3d::UnitZ()), true);
  EXPECT_LT(found.error_m, 0.02);
  EXPECT_LT(found.error_rad, 1.0 * kDegree);
}

/// Its flat front is like a cupboard's, 40 cm nearer.
TEST(PoseSearch, APersonIsNoCupboard) {
  for (const char* kind : {"cabinet", "dishwasher", "fridge"}) {
    for (const double off_axis_deg : {-55.0, -45.0, -35.0, -27.0, 27.0, 35.0, 45.0, 55.0}) {
      const Found found = searchFrom({kind}, Eigen::Isometry3d(Eigen::Translation3d(0.05, 0.02, 0.0)), true, 1.6, off_axis_deg);
      EXPECT_TRUE(found.result.status != AlignStatus::kConverged || found.error_m < 0.02)
          << kind << " from " << off_axis_deg << " deg: " << found.error_m << " m, overlap " << found.result.overlap;
    }
  }
}

/// A row of equal boxes, two of which the search reaches: neither is better.
TEST(PoseSearch, TwoThatLookAlikeAreAmbiguous) {
  const auto box = std::make_shared<const model::TriangleMesh>(model::makeBox({0.25F, 0.25F, 0.9F}));
  model::ArticulatedModel post;
  post.name = "post";
  post.parts.push_back({"post", box});
  // Side by side before the camera, each with an edge towards it, so that neither hides the other.
  const auto post_at = [](double y) {
    return Eigen::Translation3d(0.0, y, 0.45) * Eigen::AngleAxisd(45.0 * kDegree, Eigen::Vector3d::UnitZ());
  };
  render::Scene real;
  real.add(box, Eigen::Isometry3d(post_at(-0.2)));
  real.add(box, Eigen::Isometry3d(post_at(0.2)));
  real.commit();
  const Eigen::Isometry3d T_map_camera = test::cameraBefore(Eigen::Isometry3d::Identity(), 1.6, 0.0, 0.5);
  const cv::Mat depth_m = test::viewOf(real, test::kinectCamera(), T_map_camera).depth_m;
  render::Scene scene;
  const Eigen::Isometry3d T_map_between(post_at(0.0));
  const int piece = scene.add(post, T_map_between, {});
  ModelMotion motion(scene, piece, post, T_map_camera, {T_map_between, {}}, {});
  EXPECT_EQ(searchPose(motion, makeScan(depth_m, test::kinectCamera(), {}), {}).status, AlignStatus::kAmbiguous);
}

/// Square as it is, it must not be found turned by a right angle.
TEST(PoseSearch, StaysWithinItsRange) {
  const Found found =
      searchFrom({"fridge", {{"width_m", "0.6"}, {"depth_m", "0.6"}}}, Eigen::Isometry3d(Eigen::Translation3d(0.25, 0.2, 0.0)));
  EXPECT_LT(found.error_m, 0.02);
  EXPECT_LT(found.error_rad, 1.0 * kDegree);
}

/// What looks like it is half a metre beyond where it may be.
TEST(PoseSearch, WhatIsOutOfRangeIsNotFound) {
  const Eigen::Isometry3d T_model_start(Eigen::Translation3d(0.0, 0.9, 0.0));
  const Found found = searchFrom({"cabinet"}, T_model_start);
  EXPECT_NE(found.result.status, AlignStatus::kConverged);
}

TEST(PoseSearch, AnArticulatedFreedomAloneBreaksTheContract) {
  const model::ArticulatedModel cabinet = test::believed({"cabinet"});
  render::Scene scene;
  const int piece = scene.add(cabinet, Eigen::Isometry3d::Identity(), {0.0});
  ModelMotion motion(scene, piece, cabinet, Eigen::Isometry3d::Identity(), {Eigen::Isometry3d::Identity(), {0.0}},
                     {.base = false, .joints = {0}});
  EXPECT_THROW(static_cast<void>(searchPose(motion, Scan{}, {})), base::ContractViolation);
}

TEST(SearchConfig, Rules) {
  test::checkConfigRules<SearchConfig>({{"range_m", "-1", "must be >= 0"},
                                        {"range_deg", "-1", "must be >= 0"},
                                        {"good_fit", "2", "must be from 0 to 1"},
                                        {"near_m", "-1", "must be >= 0"},
                                        {"near_deg", "-1", "must be >= 0"},
                                        {"screening_iterations", "0", "must be >= 1"},
                                        {"best_starts", "0", "must be >= 1"},
                                        {"same_m", "-1", "must be >= 0"},
                                        {"same_deg", "-1", "must be >= 0"},
                                        {"min_overlap", "2", "must be from 0 to 1"},
                                        {"clear_lead", "-1", "must be >= 0"}});
}

}  // namespace
}  // namespace oikos::registration
