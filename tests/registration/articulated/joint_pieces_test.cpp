// SPDX-License-Identifier: Apache-2.0
// What the registration of joints is made of: links, windows, the mixture of a pixel, and the profile of a joint.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "registration/articulated/joint_equations.h"
#include "registration/articulated/joint_profile.h"
#include "registration/articulated/joint_tree.h"
#include "registration/articulated/pixel_mixture.h"
#include "registration/articulated/scan_window.h"
#include "tests/registration/articulated/door_world.h"
#include "tests/support/config_rules_check.h"

namespace oikos::registration {
namespace {

TEST(JointTree, KnobsBelongToWhatCarriesThem) {
  const JointTree tree(model::makeShape("oven", {}, "oven"));
  ASSERT_EQ(tree.links().size(), 2U);
  EXPECT_EQ(tree.links()[0].parts.size(), tree.model().parts.size() - 1);
  EXPECT_EQ(tree.jointOf(1).name, "door_hinge");
  EXPECT_EQ(tree.links()[1].chain, std::vector<int>{1});
  EXPECT_TRUE(tree.hangsOn(1, 0));
  EXPECT_TRUE(tree.hangsOn(1, 1));
  EXPECT_FALSE(tree.hangsOn(0, 1));
}

/// A point's velocity against the difference of where it is a little later.
TEST(JointTree, VelocitiesAreThoseOfTheKinematics) {
  for (const std::string kind : {"cabinet", "drawer_unit", "dishwasher"}) {
    const JointTree tree(model::makeShape(kind, {}, kind));
    const Eigen::Isometry3d T_map_model = Eigen::Translation3d(1.0, -2.0, 0.3) * Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ());
    const std::vector<double> values(tree.model().joints.size(), 0.2);
    const std::vector<JointAxis> axes = tree.axes(T_map_model, tree.partPoses(values));
    for (std::size_t link = 1; link < tree.links().size(); ++link) {
      const auto part = static_cast<std::size_t>(tree.links()[link].parts.front());
      const Eigen::Vector3d point_part(0.1, 0.25, -0.2);
      constexpr double kStep = 1e-6;
      std::vector<double> later = values;
      later[static_cast<std::size_t>(tree.links()[link].joint)] += kStep;
      const Eigen::Vector3d before = T_map_model * tree.partPoses(values)[part] * point_part;
      const Eigen::Vector3d after = T_map_model * tree.partPoses(later)[part] * point_part;
      EXPECT_LT(((after - before) / kStep - axes[link].velocityOf(before)).norm(), 1e-5) << kind << " " << link;
    }
  }
}

/// Each column against the difference that a small step of what is free makes to a point of the link.
TEST(JointEquations, JacobiansAreDifferences) {
  const JointTree tree(model::makeShape("drawer_unit", {}, "drawer_unit"));
  const JointTree door(model::makeShape("cabinet", {}, "cabinet"));
  constexpr double kStep = 1e-6;
  for (const JointTree* model : {&tree, &door}) {
    const Eigen::Isometry3d T_map_model = Eigen::Translation3d(1.0, -2.0, 0.3) * Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d pivot_map = T_map_model * Eigen::Vector3d(0.1, 0.0, 0.4);
    const std::vector<double> values(model->model().joints.size(), 0.15);
    for (int link = 0; link < static_cast<int>(model->links().size()); ++link) {
      const std::size_t part = static_cast<std::size_t>(model->links()[static_cast<std::size_t>(link)].parts.front());
      const auto pointAt = [&](const Eigen::Isometry3d& T_map_moved, const std::vector<double>& moved) {
        return Eigen::Vector3d(T_map_moved * model->partPoses(moved)[part] * Eigen::Vector3d(0.05, 0.2, -0.1));
      };
      PixelTerm term;
      term.link = link;
      term.model_map = pointAt(T_map_model, values);
      term.normal_map = Eigen::Vector3d(0.6, -0.5, 0.4).normalized();
      term.residual_m = 1.0;
      term.weight = 1.0;
      JointEquations equations(*model, model->axes(T_map_model, model->partPoses(values)), pivot_map, 0.005);
      equations.add(term);
      equations.gather(1.0, 100.0, std::vector<char>(model->links().size(), 1));
      const auto slope = [&](const Eigen::Vector3d& moved_map) { return -term.normal_map.dot(moved_map - term.model_map) / kStep; };
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
        EXPECT_NEAR(equations.g[i], slope(term.model_map + kStep * axis), 1e-5);
        const Eigen::Isometry3d turn = Eigen::Translation3d(pivot_map) * Eigen::AngleAxisd(kStep, axis) * Eigen::Translation3d(-pivot_map);
        EXPECT_NEAR(equations.g[3 + i], slope(pointAt(turn * T_map_model, values)), 1e-5);
        if (link > 0) {
          EXPECT_NEAR(equations.g[firstOf(link) + 1 + i], slope(term.model_map + kStep * axis), 1e-5);
        }
      }
      for (int mover = 1; mover < static_cast<int>(model->links().size()); ++mover) {
        std::vector<double> moved = values;
        moved[static_cast<std::size_t>(model->links()[static_cast<std::size_t>(mover)].joint)] += kStep;
        EXPECT_NEAR(equations.g[firstOf(mover)], slope(pointAt(T_map_model, moved)), 1e-5);
      }
      EXPECT_LT((equations.H - equations.g * equations.g.transpose()).norm(), 1e-12);
    }
  }
}

TEST(JointEquations, ManyReadingsCountForSoManyAtMost) {
  const JointTree tree(model::makeShape("cabinet", {}, "cabinet"));
  const std::vector<double> values(1, 0.0);
  PixelTerm term;
  term.normal_map = Eigen::Vector3d::UnitX();
  term.weight = 1.0;
  term.reading = 1.0;
  JointEquations equations(tree, tree.axes(Eigen::Isometry3d::Identity(), tree.partPoses(values)), Eigen::Vector3d::Zero(), 0.005);
  for (int i = 0; i < 1000; ++i) {
    equations.add(term);
  }
  term.link = 1;
  equations.add(term);
  JointEquations without_door = equations;
  equations.gather(0.5, 100.0, {1, 1});
  EXPECT_NEAR(equations.H(0, 0), 100.0 + 0.5, 1e-9);
  EXPECT_NEAR(equations.surfaces()(0, 0), std::pow(100.0 * 0.005, 2.0), 1e-9);
  without_door.gather(0.5, 100.0, {1, 0});
  EXPECT_NEAR(without_door.H(0, 0), 100.0, 1e-9);
}

TEST(ScanWindow, HoldsWhatTheBoxShows) {
  const camera::PinholeCamera camera = {160, 120, 130.0, 130.0, 80.0, 60.0};
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.1, -0.2, 1.0), Eigen::Vector3d(0.3, 0.1, 1.4));
  const PixelWindow window = windowAround(box, Eigen::Isometry3d::Identity(), camera);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector2d pixel = camera.project(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    EXPECT_GE(pixel.x(), window.left);
    EXPECT_LE(pixel.x(), window.left + window.width - 1);
    EXPECT_GE(pixel.y(), window.top);
    EXPECT_LE(pixel.y(), window.top + window.height - 1);
  }
  const Eigen::Vector3d point(0.05, -0.03, 1.2);
  const Eigen::Vector2d moved = cropped(camera, window).project(point) + Eigen::Vector2d(window.left, window.top);
  EXPECT_LT((moved - camera.project(point)).norm(), 1e-12);
}

TEST(ScanWindow, WhatIsBehindOrBesideIsEmpty) {
  const camera::PinholeCamera camera = {160, 120, 130.0, 130.0, 80.0, 60.0};
  const Eigen::AlignedBox3d behind(Eigen::Vector3d(-0.1, -0.2, -2.0), Eigen::Vector3d(0.3, 0.1, -1.0));
  const Eigen::AlignedBox3d beside(Eigen::Vector3d(5.0, -0.2, 1.0), Eigen::Vector3d(5.3, 0.1, 1.4));
  const Eigen::AlignedBox3d around(Eigen::Vector3d(-0.1, -0.2, -1.0), Eigen::Vector3d(0.3, 0.1, 1.4));
  EXPECT_TRUE(windowAround(behind, Eigen::Isometry3d::Identity(), camera).isEmpty());
  EXPECT_TRUE(windowAround(beside, Eigen::Isometry3d::Identity(), camera).isEmpty());
  EXPECT_TRUE(windowAround(Eigen::AlignedBox3d(), Eigen::Isometry3d::Identity(), camera).isEmpty());
  EXPECT_EQ(windowAround(around, Eigen::Isometry3d::Identity(), camera).width, camera.width);
}

TEST(ScanWindow, UnitedHoldsBoth) {
  const PixelWindow one = {3, 4, 5, 6};
  const PixelWindow both = one.united({1, 8, 3, 10});
  EXPECT_EQ(both.left, 1);
  EXPECT_EQ(both.top, 4);
  EXPECT_EQ(both.left + both.width, 8);
  EXPECT_EQ(both.top + both.height, 18);
  EXPECT_EQ(one.united({}).width, one.width);
  EXPECT_EQ(PixelWindow().united(one).top, one.top);
}

TEST(PixelMixture, DensitiesAreDensities) {
  const PixelMixture mixture((MixtureConfig()));
  for (const ModelledPixel surface : {ModelledPixel{1.6, 0.01, true, 0.0}, ModelledPixel{2.0, 0.02, true, 0.4}}) {
    double sum = 0.0;
    constexpr double kStep_m = 0.0005;
    for (double reading_m = 0.3; reading_m < 4.5; reading_m += kStep_m) {
      sum += kStep_m * std::exp(mixture.logOfSurface(reading_m, surface));
    }
    EXPECT_NEAR(sum, 1.0, 0.01);
  }
  EXPECT_NEAR(std::exp(mixture.logOfNothing()) * (4.5 - 0.3), 1.0, 1e-12);
}

TEST(PixelMixture, EachComponentHasItsPlace) {
  const PixelMixture mixture((MixtureConfig()));
  const ModelledPixel front = {1.5, 0.01, true, 0.0};
  const ModelledPixel inside = {2.0, 0.01, true, 0.5};
  EXPECT_GT(mixture.shareOfSurface(1.505, front), 0.95);
  EXPECT_LT(mixture.shareOfSurface(1.3, front), 0.01);
  EXPECT_LT(mixture.shareOfSurface(1.7, front), 0.01);
  EXPECT_GT(mixture.logOfSurface(1.3, front), mixture.logOfSurface(1.7, front));    // in front is likelier than through it
  EXPECT_GT(mixture.logOfSurface(1.7, inside), mixture.logOfSurface(1.3, inside));  // contents are likelier than a hand before them
  ModelledPixel turned = front;
  turned.faces = false;
  EXPECT_LT(mixture.logOfSurface(1.5, turned), mixture.logOfSurface(1.5, front));
}

TEST(PixelMixture, RaysMeetBoxes) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(1.0, -1.0, -1.0), Eigen::Vector3d(2.0, 1.0, 1.0));
  EXPECT_DOUBLE_EQ(distanceToBox(box, Eigen::Vector3d::Zero(), Eigen::Vector3d(2.0, 0.0, 0.0)), 0.5);
  EXPECT_DOUBLE_EQ(distanceToBox(box, Eigen::Vector3d(1.5, 0.0, 0.0), Eigen::Vector3d::UnitX()), 0.0);
  EXPECT_EQ(distanceToBox(box, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(distanceToBox(box, Eigen::Vector3d::Zero(), Eigen::Vector3d(1.0, 1.1, 0.0)), std::numeric_limits<double>::infinity());
}

TEST(PixelMixture, ConfigurationRules) {
  test::checkConfigRules<MixtureConfig>({{"as_modelled", "0.95", "must be > contents, and with nearer and behind < 1"},
                                         {"as_modelled", "0.3", "must be > contents, and with nearer and behind < 1"},
                                         {"nearer", "0", "must be > 0"},
                                         {"behind", "0", "must be > 0"},
                                         {"contents", "-1", "must be >= 0"},
                                         {"min_room_m", "-1", "must be >= 0"},
                                         {"max_normal_deg", "0", "must be > 0 and <= 90"},
                                         {"range_m", "0.5", "must be > 0.5"}});
}

/// The true value explains the image better than any other, be the other parts known or not.
TEST(JointProfiler, TheTruthIsTheBestValue) {
  DoorWorld world("cabinet", {{"door_count", "2"}, {"width_m", "0.9"}});
  world.values = {48.0 * kDegree, 20.0 * kDegree};
  const Scan scan = world.scan();
  const JointTree tree(world.model);
  LinkLayers layers(tree, 1);
  const PixelMixture mixture((MixtureConfig()));
  for (const JointProfiler::Others others : {JointProfiler::Others::kBaseOnly, JointProfiler::Others::kAll}) {
    JointProfiler profiler(tree, layers, scan, world.T_map_camera, mixture);
    profiler.stand(world.believed(world.values), others, 0.005);
    for (const int link : {1, 2}) {
      profiler.choose(link);
      const double truth = world.values[static_cast<std::size_t>(link - 1)];
      const ValueScore best = profiler.score(truth);
      EXPECT_GT(best.agreeing, 0.8 * best.pixels);  // the others lie on its edges
      for (double value = 0.0; value < 110.0 * kDegree; value += 2.0 * kDegree) {
        if (std::abs(value - truth) > 1.0 * kDegree) {
          EXPECT_LT(profiler.score(value).log_likelihood, best.log_likelihood) << value / kDegree;
        }
      }
    }
  }
}

}  // namespace
}  // namespace oikos::registration
