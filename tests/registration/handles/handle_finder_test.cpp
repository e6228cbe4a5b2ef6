// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/handle_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/model/primitives.h"
#include "tests/registration/articulated/door_world.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"

namespace oikos::registration {
namespace {

using Eigen::Vector3d;

constexpr double kGrip_m = 0.03;  // of a bar's middle before the front

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A front of 0.6 m by 0.7 m whose face is x = 0 of its part, which is believed to have `handles`, and a perfect camera before it.
struct FrontWorld {
  model::ArticulatedModel believed;
  model::ArticulatedModel real;
  Eigen::Isometry3d T_map_part = at(0.4, -0.3, 1.3) * Eigen::AngleAxisd(0.7, Vector3d::UnitZ());
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  std::vector<Eigen::AlignedBox3d> obstacles_part;

  FrontWorld() {
    for (model::ArticulatedModel* model : {&believed, &real}) {
      model->name = "front";
      model->parts.push_back({"front", cuboid({Vector3d(-0.02, -0.3, -0.35), Vector3d(0.0, 0.3, 0.35)})});
    }
    lookFrom(1.0, 0.0);
  }

  /// The camera `distance_m` from the front's middle, as high as its middle and to its left.
  void lookFrom(double distance_m, double off_axis_deg) {
    T_map_camera = test::cameraBefore(T_map_part * at(0.0, 0.0, -1.3), distance_m, off_axis_deg * kDegree, 1.3);
  }
  void addToReal(const model::TriangleMesh& shape, const Eigen::Isometry3d& T_part_shape) {
    auto mesh = std::make_shared<model::TriangleMesh>(*real.parts[0].mesh_part);
    const std::vector<model::Material> materials = mesh->materials;
    append(*mesh, shape, T_part_shape);
    mesh->materials = materials;
    mesh->triangle_materials.assign(mesh->triangles.size(), 0);
    real.parts[0].mesh_part = mesh;
  }
  /// An upright bar of 12 mm by 12 mm that is believed at (y, z) and is `off` from there.
  void addBar(const Vector3d& place_part, const Vector3d& off, double length_m = 0.16) {
    believed.handles.push_back({"bar", 0, at(kGrip_m, place_part.y(), place_part.z()), length_m, model::HandleKind::kBar});
    addToReal(model::makeBox({0.012F, 0.012F, static_cast<float>(length_m)}),
              believed.handles.back().T_part_handle * Eigen::Translation3d(off));
    real.handles.push_back(believed.handles.back());
    real.handles.back().T_part_handle.translate(off);
  }
  void addKnob(const Vector3d& place_part, const Vector3d& off) {
    believed.handles.push_back({"knob", 0, at(0.011, place_part.y(), place_part.z()), 0.028, model::HandleKind::kKnob});
    const Eigen::Isometry3d T =
        believed.handles.back().T_part_handle * Eigen::Translation3d(off) * Eigen::AngleAxisd(std::numbers::pi / 2.0, Vector3d::UnitY());
    addToReal(model::makeCylinder({.radius_m = 0.014F, .length_m = 0.022F, .segments = 32}), T);
    real.handles.push_back(believed.handles.back());
    real.handles.back().T_part_handle.translate(off);
  }

  [[nodiscard]] DepthView view() const {
    render::Scene scene;
    scene.add(real, T_map_part, {});
    const auto addBox = [&](const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& T_map_box) { scene.add(cuboid(box), T_map_box); };
    addBox({Vector3d(-0.9, -4.0, -2.0), Vector3d(-0.8, 4.0, 2.0)}, T_map_part);
    for (const Eigen::AlignedBox3d& obstacle : obstacles_part) {
      addBox(obstacle, T_map_part);
    }
    scene.commit();
    const camera::PinholeCamera camera = test::kinectCamera();
    return {test::viewOf(scene, camera, T_map_camera).depth_m, camera, T_map_camera};
  }
  [[nodiscard]] std::vector<HandleEstimate> find(const DepthView& view, const HandleConfig& config = {}) const {
    return HandleFinder(believed, config).find(view, 0, T_map_part);
  }
  [[nodiscard]] std::vector<HandleEstimate> find() const { return find(view()); }
  [[nodiscard]] Vector3d errorOf(const HandleEstimate& estimate) const {
    return (real.handles[static_cast<std::size_t>(estimate.handle)].T_part_handle.inverse() * estimate.T_part_handle).translation();
  }
};

double degreesBetween(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::min(1.0, a.dot(b))) / kDegree;
}

/// Half a pixel's width, and half a millimetre for what is seen of a bar's sides: an upright bar has its edges in the same part of a pixel
/// all along.
double tolerance(double distance_m) {
  return std::max(0.001, 0.5 * distance_m / test::kinectCamera().fx + 0.0006);
}

TEST(HandleFinder, ABarIsFoundToHalfAPixel) {
  for (const double distance_m : {0.8, 1.3}) {
    for (const double off_axis_deg : {-15.0, 0.0, 20.0}) {
      FrontWorld world;
      world.addBar({0.0, 0.2, 0.15}, {0.0, 0.009, -0.012});
      world.lookFrom(distance_m, off_axis_deg);
      const std::vector<HandleEstimate> found = world.find();
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0].status, HandleStatus::kFound);
      EXPECT_LT(world.errorOf(found[0]).norm(), tolerance(distance_m))
          << distance_m << " from " << off_axis_deg << ": " << world.errorOf(found[0]).transpose();
      EXPECT_LT(degreesBetween(found[0].T_map_handle.linear().col(0), world.T_map_part.linear().col(0)), 0.05);
      EXPECT_LT(degreesBetween(found[0].T_map_handle.linear().col(2), world.T_map_part.linear().col(2)), 0.3);
      EXPECT_NEAR(found[0].length_m, 0.16, 0.006);
      EXPECT_GT(found[0].points, 20);
      EXPECT_GT(found[0].front_points, 500);
      EXPECT_LT((found[0].T_map_handle.matrix() - (world.T_map_part * found[0].T_part_handle).matrix()).norm(), 1e-12);
      EXPECT_GT(found[0].covariance.ldlt().vectorD().minCoeff(), 0.0);
      for (int i = 0; i < 3; ++i) {
        EXPECT_LT(std::abs(world.errorOf(found[0])[i]), 3.0 * std::sqrt(found[0].covariance(i, i)));
      }
    }
  }
}

TEST(HandleFinder, TheFrontIsFoundWhereItIs) {
  FrontWorld world;
  world.addBar({0.0, 0.0, 0.0}, {0.0, 0.005, 0.005});
  const DepthView view = world.view();
  const Eigen::Isometry3d T_map_true = world.T_map_part * world.real.handles[0].T_part_handle;
  world.T_map_part = world.T_map_part * at(0.008, 0.0, 0.0) * Eigen::AngleAxisd(0.5 * kDegree, Vector3d(0.0, 0.6, 0.8));
  const HandleEstimate found = world.find(view).at(0);
  EXPECT_EQ(found.status, HandleStatus::kFound);
  EXPECT_LT((found.T_map_handle.translation() - T_map_true.translation()).norm(), tolerance(1.0));
  EXPECT_LT(degreesBetween(found.T_map_handle.linear().col(0), T_map_true.linear().col(0)), 0.05);
}

TEST(HandleFinder, AKnobIsFound) {
  constexpr double kTolerance_m = 0.003;  // of how much of its side is seen beside its end
  for (const double off_axis_deg : {-20.0, 0.0, 20.0}) {
    FrontWorld world;
    world.addKnob({0.0, 0.1, 0.0}, {0.0, -0.01, 0.014});
    world.lookFrom(0.9, off_axis_deg);
    const HandleEstimate found = world.find().at(0);
    EXPECT_EQ(found.status, HandleStatus::kFound);
    EXPECT_LT(world.errorOf(found).norm(), kTolerance_m) << off_axis_deg << ": " << world.errorOf(found).transpose();
    EXPECT_NEAR(found.length_m, 0.028, 0.006);
  }
}

TEST(HandleFinder, ARecessedGripIsNotVisible) {
  FrontWorld world;
  world.addBar({0.0, 0.0, 0.1}, Vector3d::Zero());
  world.believed.handles[0].kind = model::HandleKind::kRecessed;
  const HandleEstimate found = world.find().at(0);
  EXPECT_EQ(found.status, HandleStatus::kRecessed);
  EXPECT_LT((found.T_part_handle.translation() - world.believed.handles[0].T_part_handle.translation()).norm(), 0.0005);
  EXPECT_FALSE(found.isSeen());
}

TEST(HandleFinder, ABareFrontHasNoHandle) {
  FrontWorld world;
  world.believed.handles.push_back({"bar", 0, at(kGrip_m, 0.1, 0.1), 0.16, model::HandleKind::kBar});
  const HandleEstimate found = world.find().at(0);
  EXPECT_EQ(found.status, HandleStatus::kNotSeen);
  EXPECT_NEAR(found.covariance(1, 1), GripConfig().place_sigma_m * GripConfig().place_sigma_m, 1e-9);
}

TEST(HandleFinder, AnEdgeThatGoesOnIsNoHandle) {
  FrontWorld world;
  Eigen::Isometry3d level = at(kGrip_m, 0.0, 0.29);
  level.rotate(Eigen::AngleAxisd(-std::numbers::pi / 2.0, Vector3d::UnitX()));
  world.believed.handles.push_back({"bar", 0, level, 0.2, model::HandleKind::kBar});
  world.addToReal(model::makeBox({0.05F, 1.0F, 0.04F}), at(0.01, 0.0, 0.33));
  EXPECT_FALSE(world.find().at(0).isSeen());
}

TEST(HandleFinder, AHiddenHandleIsSaidToBeHidden) {
  FrontWorld world;
  world.addBar({0.0, 0.2, 0.15}, {0.0, 0.01, 0.0});
  world.obstacles_part.emplace_back(Vector3d(0.3, 0.0, -0.1), Vector3d(0.4, 0.4, 0.5));
  const HandleEstimate found = world.find().at(0);
  EXPECT_EQ(found.status, HandleStatus::kHidden);
  EXPECT_LT((found.T_part_handle.translation() - world.believed.handles[0].T_part_handle.translation()).norm(), 0.001);
}

TEST(HandleFinder, WhatIsHiddenOfItsPlaceComesFromThePrior) {
  FrontWorld world;
  world.addBar({0.0, 0.0, 0.0}, {0.0, 0.01, 0.012}, 0.3);
  world.T_map_camera = test::cameraBefore(world.T_map_part * at(0.0, 0.0, -1.3), 1.0, 0.0, 1.3);
  for (const double side : {-1.0, 1.0}) {  // before both of its ends
    const double low = side < 0.0 ? -0.4 : 0.12;
    world.obstacles_part.emplace_back(Vector3d(0.12, -0.1, low), Vector3d(0.13, 0.1, low + 0.28));
  }
  const HandleEstimate found = world.find().at(0);
  EXPECT_EQ(found.status, HandleStatus::kPartly);
  EXPECT_NEAR(world.errorOf(found).y(), 0.0, 0.001);
  EXPECT_NEAR(found.T_part_handle.translation().z(), 0.0, 0.004);  // as believed
  EXPECT_GT(std::sqrt(found.covariance(2, 2)), 0.008);
}

TEST(HandleFinder, NoReadingsAtTheHandle) {
  FrontWorld world;
  world.addBar({0.0, 0.2, 0.15}, {0.0, 0.0, 0.0});
  DepthView view = world.view();
  const HandleEstimate whole = world.find(view).at(0);
  ASSERT_EQ(whole.status, HandleStatus::kFound);
  const Eigen::Vector2d pixel = view.camera.project(view.T_map_camera.inverse() * whole.T_map_handle.translation());
  const cv::Rect around(static_cast<int>(pixel.x()) - 60, static_cast<int>(pixel.y()) - 90, 120, 180);
  view.depth_m(around & cv::Rect(0, 0, view.depth_m.cols, view.depth_m.rows)) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(world.find(view).at(0).status, HandleStatus::kTooFewPoints);
  view.depth_m = std::numeric_limits<float>::quiet_NaN();
  const HandleEstimate blind = world.find(view).at(0);
  EXPECT_EQ(blind.status, HandleStatus::kNoFront);
  EXPECT_LT((blind.T_part_handle.matrix() - world.believed.handles[0].T_part_handle.matrix()).norm(), 1e-12);
}

TEST(HandleFinder, OutOfTheImageOrFacingAway) {
  FrontWorld world;
  world.addBar({0.0, 0.2, 0.15}, {0.0, 0.0, 0.0});
  const DepthView view = world.view();
  DepthView turned = view;
  turned.T_map_camera.rotate(Eigen::AngleAxisd(60.0 * kDegree, Vector3d::UnitY()));
  EXPECT_EQ(world.find(turned).at(0).status, HandleStatus::kNotInView);
  world.lookFrom(1.0, 85.0);
  EXPECT_EQ(world.find().at(0).status, HandleStatus::kNotInView);
}

TEST(HandleFinder, TwoHandlesOfOneFrontAreNotTheSame) {
  FrontWorld world;
  world.addKnob({0.0, -0.035, 0.1}, {0.0, 0.013, 0.0});  // each of them nearer to the other's believed place than it was
  world.addKnob({0.0, 0.035, 0.1}, {0.0, 0.013, 0.01});
  const std::vector<HandleEstimate> found = world.find();
  ASSERT_EQ(found.size(), 2U);
  for (const HandleEstimate& handle : found) {
    EXPECT_EQ(handle.status, HandleStatus::kFound);
    EXPECT_LT(world.errorOf(handle).norm(), 0.002) << world.errorOf(handle).transpose();
  }
}

TEST(HandleFinder, TheSameBytesEachTime) {
  FrontWorld world;
  world.addBar({0.0, 0.2, 0.15}, {0.0, 0.01, 0.0});
  world.addKnob({0.0, -0.2, 0.15}, {0.0, 0.01, 0.0});
  const std::vector<HandleEstimate> once = world.find();
  const std::vector<HandleEstimate> again = world.find();
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].T_map_handle.matrix(), again[i].T_map_handle.matrix());
    EXPECT_EQ(once[i].covariance, again[i].covariance);
  }
}

TEST(HandleFinder, WhatItIsToldIsChecked) {
  FrontWorld world;
  world.addBar({0.0, 0.2, 0.15}, {0.0, 0.0, 0.0});
  DepthView view = world.view();
  view.depth_m = cv::Mat(480, 640, CV_16UC1, cv::Scalar(0));
  EXPECT_THROW((void)world.find(view), base::ContractViolation);
  HandleConfig config;
  config.grip.search_m = -1.0;
  EXPECT_THROW(HandleFinder(world.believed, config), base::ContractViolation);
  EXPECT_EQ(config.validate(), std::vector<std::string>{"grip.search_m = -1: must be > 0"});
  world.believed.handles[0].part = 7;
  EXPECT_THROW(HandleFinder(world.believed, {}), base::Error);
  test::checkEnumTable(HandleStatus::kNoFront);
}

}  // namespace
}  // namespace oikos::registration
