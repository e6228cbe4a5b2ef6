// SPDX-License-Identifier: Apache-2.0
#include "registration/align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/model/primitives.h"
#include "core/render/view.h"
#include "tests/registration/furniture_scan.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"

namespace oikos::registration {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A cabinet seen by a perfect camera, with a corner of the room around it.
struct CabinetWorld {
  model::ArticulatedModel cabinet = test::believed({"cabinet"});
  Eigen::Isometry3d T_map_model = Eigen::Translation3d(0.5, -0.4, 0.0) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ());
  Eigen::Isometry3d T_map_camera = test::cameraBefore(T_map_model, 1.9, 40.0 * kDegree, 0.5);
  std::vector<double> joints = std::vector<double>(cabinet.joints.size(), 0.0);

  [[nodiscard]] cv::Mat depth(camera::DepthSensorKind sensor = camera::DepthSensorKind::kIdeal) const {
    test::FurnitureScene scene;
    scene.model = &cabinet;
    scene.joint_values = joints;
    scene.T_map_model = T_map_model;
    scene.T_map_camera = T_map_camera;
    scene.sensor = sensor;
    return test::recordDepth(scene, test::kinectCamera());
  }
  [[nodiscard]] Scan scan(camera::DepthSensorKind sensor = camera::DepthSensorKind::kIdeal) const {
    return makeScan(depth(sensor), test::kinectCamera(), {});
  }
};

Eigen::Isometry3d planar(double x, double y, double yaw) {
  return Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

struct Error {
  double metres;
  double radians;
};
Error between(const Eigen::Isometry3d& T_map_a, const Eigen::Isometry3d& T_map_b) {
  const Eigen::Isometry3d T_a_b = T_map_a.inverse() * T_map_b;
  return {T_a_b.translation().norm(), Eigen::AngleAxisd(T_a_b.linear()).angle()};
}

class AlignTest : public testing::TestWithParam<Association> {
 protected:
  static AlignConfig config() {
    AlignConfig config;
    config.association = GetParam();
    config.surface_sigma_m = 0.001;
    return config;
  }
};

/// The model is brought to where the scan has it, from a grid of starts.
TEST_P(AlignTest, AMovedModelIsFound) {
  const CabinetWorld world;
  const Scan scan = world.scan();
  for (const double x : {-0.08, 0.08}) {
    for (const double y : {-0.08, 0.08}) {
      for (const double yaw : {-5.0 * kDegree, 5.0 * kDegree}) {
        render::Scene scene;
        const Eigen::Isometry3d T_map_start = world.T_map_model * planar(x, y, yaw);
        const int piece = scene.add(world.cabinet, T_map_start, world.joints);
        ModelMotion motion(scene, piece, world.cabinet, world.T_map_camera, {T_map_start, world.joints}, {});
        const AlignResult result = align(motion, scan, config());
        EXPECT_EQ(result.status, AlignStatus::kConverged) << x << " " << y << " " << yaw;
        const Error error = between(world.T_map_model, motion.pose().T_map_model);
        EXPECT_LT(error.metres, 0.004) << x << " " << y << " " << yaw;
        EXPECT_LT(error.radians, 0.3 * kDegree) << x << " " << y << " " << yaw;
        EXPECT_GT(result.overlap, 0.9);
        EXPECT_LT(result.rms_m, 0.003);
        EXPECT_NEAR(result.moved_m, std::hypot(x, y), 0.05);
        EXPECT_NEAR(result.moved_rad, std::abs(yaw), 0.006);
      }
    }
  }
}

/// The inverse: the model stands where it is believed, and the camera is brought to where it was (S215, S219).
TEST_P(AlignTest, AMovedCameraIsFound) {
  const CabinetWorld world;
  const Scan scan = world.scan();
  render::Scene scene;
  scene.add(world.cabinet, world.T_map_model, world.joints);
  scene.commit();
  for (const double side : {-1.0, 1.0}) {
    CameraMotion motion(scene,
                        planar(0.06 * side, -0.05, 0.0) * world.T_map_camera *
                            Eigen::AngleAxisd(-side * 2.0 * kDegree, Eigen::Vector3d(world.T_map_camera.linear().transpose().col(2))),
                        PoseFreedom::kPlanar);
    const AlignResult result = align(motion, scan, config());
    EXPECT_EQ(result.status, AlignStatus::kConverged);
    const Error error = between(world.T_map_camera, motion.T_map_camera());
    EXPECT_LT(error.metres, 0.006);
    EXPECT_LT(error.radians, 0.2 * kDegree);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, AlignTest, testing::Values(Association::kProjective, Association::kNearest),
                         [](const auto& test) { return std::string(base::toString(test.param)); });

TEST(Align, ExactDepthGivesTheExactPose) {
  const CabinetWorld world;
  render::Scene scene;
  const Eigen::Isometry3d T_map_start = world.T_map_model * planar(0.03, 0.02, 2.0 * kDegree);
  const int piece = scene.add(world.cabinet, T_map_start, world.joints);
  scene.commit();
  // The piece alone, as the renderer itself sees it: nothing but the arithmetic is between the two.
  render::Scene alone;
  alone.add(world.cabinet, world.T_map_model, world.joints);
  alone.commit();
  const cv::Mat depth_m = test::viewOf(alone, test::kinectCamera(), world.T_map_camera).depth_m;
  ModelMotion motion(scene, piece, world.cabinet, world.T_map_camera, {T_map_start, world.joints}, {});
  AlignConfig config;
  config.has_edges = false;
  config.fine_iterations = 40;
  config.fine_gate_m = 0.01;
  const AlignResult result = align(motion, makeScan(depth_m, test::kinectCamera(), {}), config);
  EXPECT_EQ(result.status, AlignStatus::kConverged);
  const Error error = between(world.T_map_model, motion.pose().T_map_model);
  EXPECT_LT(error.metres, 2e-5);  // floats of the depth image
  EXPECT_LT(error.radians, 2e-5);
}

TEST(Align, OneDoorIsOneFreedom) {
  CabinetWorld world;
  world.joints[0] = 50.0 * kDegree;
  const Scan scan = world.scan();
  for (const double start_deg : {35.0, 65.0}) {
    const std::vector<double> start{start_deg * kDegree};
    render::Scene scene;
    const int piece = scene.add(world.cabinet, world.T_map_model, start);
    ModelMotion motion(scene, piece, world.cabinet, world.T_map_camera, {world.T_map_model, start}, {.base = false, .joints = {0}});
    const AlignResult result = align(motion, scan, {});
    EXPECT_EQ(result.status, AlignStatus::kConverged);
    EXPECT_NEAR(motion.pose().joint_values[0], world.joints[0], 0.5 * kDegree);
  }
}

/// A wall and nothing else: along it there is nothing to see.
TEST(Align, ASingleWallIsDegenerateAlongItself) {
  render::Scene scene;
  const auto wall = std::make_shared<const model::TriangleMesh>(model::makeBox({0.1F, 20.0F, 6.0F}));
  scene.add(wall, Eigen::Isometry3d(Eigen::Translation3d(2.05, 0.0, 0.0)));
  scene.commit();
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // looks along x
  const camera::PinholeCamera camera = test::kinectCamera();
  const cv::Mat depth_m = test::sensed(test::viewOf(scene, camera, T_map_camera), camera, camera::DepthSensorKind::kKinect1, 3);
  CameraMotion motion(scene, planar(-0.05, 0.1, 3.0 * kDegree) * T_map_camera, PoseFreedom::kPlanar);
  const AlignResult result = align(motion, makeScan(depth_m, camera, {}), {});
  EXPECT_EQ(result.status, AlignStatus::kDegenerate);
  EXPECT_EQ(result.unobserved, std::vector<std::string>{"y"});
  EXPECT_NEAR(motion.T_map_camera().translation().x(), 0.0, 0.005);  // what is seen is mended,
  EXPECT_NEAR(motion.T_map_camera().translation().y(), 0.1, 0.01);   // what is not is left alone
  EXPECT_GT(result.covariance(1, 1), 0.5);
  EXPECT_LT(result.covariance(0, 0), 0.01 * 0.01);
}

struct Refusal {
  std::string name;
  cv::Mat depth_m;
  AlignStatus status;
};

TEST(Align, SaysWhatIsMissing) {
  const CabinetWorld world;
  const cv::Mat there = world.depth();
  cv::Mat dark(480, 640, CV_32FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  cv::Mat far_wall(480, 640, CV_32FC1, cv::Scalar(4.4));
  cv::Mat hand(480, 640, CV_32FC1, cv::Scalar(0.5));
  cv::Mat five_points = dark.clone();
  for (int i = 0; i < 5; ++i) {
    five_points.at<float>(240, 300 + 4 * i) = there.at<float>(240, 300 + 4 * i);
  }
  for (const Refusal& refusal : {Refusal{"no depth", dark, AlignStatus::kNotInView},
                                 {"five points", five_points, AlignStatus::kNotInView},
                                 {"it has gone", far_wall, AlignStatus::kTooLittleOverlap},
                                 {"a hand before the lens", hand, AlignStatus::kNotInView}}) {
    render::Scene scene;
    const int piece = scene.add(world.cabinet, world.T_map_model, world.joints);
    ModelMotion motion(scene, piece, world.cabinet, world.T_map_camera, {world.T_map_model, world.joints}, {});
    const AlignResult result = align(motion, makeScan(refusal.depth_m, test::kinectCamera(), {}), {});
    EXPECT_EQ(result.status, refusal.status) << refusal.name;
    EXPECT_EQ(motion.pose().T_map_model.matrix(), world.T_map_model.matrix()) << refusal.name << ": the last accepted estimate";
  }
}

TEST(Align, BehindTheCameraIsNotInView) {
  const CabinetWorld world;
  const Scan scan = world.scan();
  render::Scene scene;
  const Eigen::Isometry3d T_map_behind = planar(20.0, 0.0, 0.0) * world.T_map_model;
  const int piece = scene.add(world.cabinet, T_map_behind, world.joints);
  ModelMotion motion(scene, piece, world.cabinet, world.T_map_camera, {T_map_behind, world.joints}, {});
  EXPECT_EQ(align(motion, scan, {}).status, AlignStatus::kNotInView);
}

TEST(Align, StoppingEarlyIsSaid) {
  const CabinetWorld world;
  render::Scene scene;
  const Eigen::Isometry3d T_map_start = world.T_map_model * planar(0.05, 0.03, 3.0 * kDegree);
  const int piece = scene.add(world.cabinet, T_map_start, world.joints);
  ModelMotion motion(scene, piece, world.cabinet, world.T_map_camera, {T_map_start, world.joints}, {});
  AlignConfig config;
  config.coarse_iterations = 0;
  config.fine_iterations = 1;
  EXPECT_EQ(align(motion, world.scan(), config).status, AlignStatus::kIterationLimit);
}

TEST(Align, AtTheAnswerItStays) {
  const CabinetWorld world;
  render::Scene scene;
  const int piece = scene.add(world.cabinet, world.T_map_model, world.joints);
  ModelMotion motion(scene, piece, world.cabinet, world.T_map_camera, {world.T_map_model, world.joints}, {});
  const AlignResult result = align(motion, world.scan(camera::DepthSensorKind::kKinect1), {});
  EXPECT_EQ(result.status, AlignStatus::kConverged);
  EXPECT_LT(result.moved_m, 0.004);
  EXPECT_LT(result.moved_rad, 0.2 * kDegree);
}

TEST(Align, SameBytesForAnyNumberOfThreads) {
  const CabinetWorld world;
  const Scan scan = world.scan(camera::DepthSensorKind::kKinect1);
  std::vector<double> first;
  for (const int threads : {1, 2, 3}) {
    render::Scene scene;
    const Eigen::Isometry3d T_map_start = world.T_map_model * planar(0.05, 0.03, 3.0 * kDegree);
    const int piece = scene.add(world.cabinet, T_map_start, world.joints);
    ModelMotion motion(scene, piece, world.cabinet, world.T_map_camera, {T_map_start, world.joints}, {});
    AlignConfig config;
    config.threads = threads;
    const AlignResult result = align(motion, scan, config);
    std::vector<double> state = motion.saved();
    state.insert(state.end(), result.covariance.data(), result.covariance.data() + result.covariance.size());
    if (first.empty()) {
      first = state;
    }
    EXPECT_EQ(state, first) << threads << " threads";
  }
}

TEST(AlignStatus, EveryValueHasAName) {
  test::checkEnumTable(AlignStatus::kConverged);
}

TEST(AlignConfig, Rules) {
  test::checkConfigRules<AlignConfig>({{"coarse_columns", "7", "must be >= 8"},
                                       {"coarse_iterations", "-1", "must be >= 0"},
                                       {"fine_iterations", "0", "must be >= 1"},
                                       {"coarse_gate_m", "0.04", "must be >= 0.05"},
                                       {"fine_gate_m", "0", "must be > 0"},
                                       {"max_normal_deg", "0", "must be > 0 and <= 90"},
                                       {"surface_sigma_m", "-1", "must be >= 0"},
                                       {"normal_sigma_deg", "0", "must be > 0"},
                                       {"min_observability", "1", "must be > 1"},
                                       {"min_inliers", "5", "must be >= 6"},
                                       {"min_overlap", "1.1", "must be from 0 to 1"},
                                       {"max_hidden", "1.1", "must be from 0 to 1"},
                                       {"threads", "0", "must be >= 1"}});
}

}  // namespace
}  // namespace oikos::registration
