// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/rfc3339.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/simulate/statistics.h"

namespace oikos::simulate {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr int kSeeds = 2000;

SceneScript scriptOf(camera::DepthSensorKind sensor) {
  SceneScript script;
  script.sensor = sensor;
  script.start = "2026-03-02T08:00:00.5+01:00";
  script.camera.distortion = {0.1, -0.2, 0.001, -0.002, 0.05};
  script.rate_hz = 12.5;
  return script;
}

void expectEqual(const camera::PinholeCamera& a, const camera::PinholeCamera& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.fx, b.fx);
  EXPECT_EQ(a.fy, b.fy);
  EXPECT_EQ(a.cx, b.cx);
  EXPECT_EQ(a.cy, b.cy);
}

void expectRoundTrip(const SceneScript& script) {
  const camera::Calibration written = nominalCalibration(script);
  const test::TemporaryFolder folder;
  const camera::Calibration read = camera::readCalibration(folder.write("camera.toml", toToml(written, script.start)));
  expectEqual(read.color, written.color);
  EXPECT_EQ(read.distortion.k1, written.distortion.k1);
  EXPECT_EQ(read.distortion.k2, written.distortion.k2);
  EXPECT_EQ(read.distortion.p1, written.distortion.p1);
  EXPECT_EQ(read.distortion.p2, written.distortion.p2);
  EXPECT_EQ(read.distortion.k3, written.distortion.k3);
  EXPECT_EQ(read.depth_scale, written.depth_scale);
  EXPECT_EQ(read.depth_distortion, 0.0);
  EXPECT_EQ(read.rate_hz, script.rate_hz);
  EXPECT_EQ(read.start_ns, base::parseRfc3339Ns(script.start));
  ASSERT_TRUE(read.T_base_camera);
  EXPECT_TRUE(read.T_base_camera->isApprox(*written.T_base_camera, 1e-14));
  ASSERT_EQ(read.depth.has_value(), written.depth.has_value());
  if (read.depth) {
    expectEqual(read.depth->pinhole, written.depth->pinhole);
    EXPECT_TRUE(read.depth->T_color_depth.isApprox(written.depth->T_color_depth, 1e-14));
  }
}

TEST(ToToml, ReadsBackEqual) {
  expectRoundTrip(scriptOf(camera::DepthSensorKind::kIdeal));
  expectRoundTrip(scriptOf(camera::DepthSensorKind::kKinect1));
  expectRoundTrip(scriptOf(camera::DepthSensorKind::kKinect2));
  expectRoundTrip(SceneScript());
}

TEST(NominalCalibration, TheMountLooksForwardsAndDown) {
  SceneScript script;
  script.camera.tilt_deg = 20.0;
  script.camera.forward_m = 0.2;
  script.camera.height_m = 1.2;
  const Eigen::Isometry3d T_base_camera = *nominalCalibration(script).T_base_camera;
  EXPECT_LT((T_base_camera.translation() - Eigen::Vector3d(0.2, 0.0, 1.2)).norm(), 1e-15);
  const double tilt_rad = 20.0 * kRadPerDeg;
  EXPECT_LT((T_base_camera.linear().col(2) - Eigen::Vector3d(std::cos(tilt_rad), 0.0, -std::sin(tilt_rad))).norm(), 1e-14);
  EXPECT_LT((T_base_camera.linear().col(0) - Eigen::Vector3d(0.0, -1.0, 0.0)).norm(), 1e-14);
  EXPECT_NEAR(T_base_camera.linear().determinant(), 1.0, 1e-14);
}

TEST(NominalCalibration, OnlyTheIdealSensorIsOneCamera) {
  EXPECT_FALSE(nominalCalibration(scriptOf(camera::DepthSensorKind::kIdeal)).depth);
  const camera::Calibration kinect2 = nominalCalibration(scriptOf(camera::DepthSensorKind::kKinect2));
  ASSERT_TRUE(kinect2.depth);
  EXPECT_EQ(kinect2.depth->pinhole.width, 512);
  EXPECT_EQ(kinect2.depth->pinhole.height, 424);
  EXPECT_TRUE(nominalCalibration(scriptOf(camera::DepthSensorKind::kKinect1)).depth);
}

TEST(TrueCalibration, WithoutDeviationsIsTheNominal) {
  const camera::Calibration nominal = nominalCalibration(scriptOf(camera::DepthSensorKind::kKinect1));
  const camera::Calibration made = trueCalibration(nominal, BeliefSettings(), 5);
  expectEqual(made.color, nominal.color);
  expectEqual(made.depth->pinhole, nominal.depth->pinhole);
  EXPECT_TRUE(made.T_base_camera->isApprox(*nominal.T_base_camera, 1e-15));
}

TEST(TrueCalibration, HasTheDeviationsOfTheScript) {
  const camera::Calibration nominal = nominalCalibration(scriptOf(camera::DepthSensorKind::kKinect1));
  BeliefSettings belief;
  belief.mount_m = 0.01;
  belief.mount_deg = 0.5;
  belief.intrinsics_share = 0.005;
  std::vector<double> shifts_m;
  std::vector<double> turns_rad;
  std::vector<double> color_focals;
  std::vector<double> depth_focals;
  std::vector<double> centers;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const camera::Calibration made = trueCalibration(nominal, belief, seed);
    const Eigen::Isometry3d T_nominal_true = nominal.T_base_camera->inverse() * *made.T_base_camera;
    for (int i = 0; i < 3; ++i) {
      shifts_m.push_back(T_nominal_true.translation()[i]);
    }
    const Eigen::AngleAxisd turn(T_nominal_true.linear());
    for (int i = 0; i < 3; ++i) {
      turns_rad.push_back(turn.angle() * turn.axis()[i] * std::sqrt(3.0));  // the angle is spread over three axes
    }
    EXPECT_DOUBLE_EQ(made.color.fx / made.color.fy, nominal.color.fx / nominal.color.fy);
    color_focals.push_back(made.color.fx / nominal.color.fx - 1.0);
    depth_focals.push_back(made.depth->pinhole.fx / nominal.depth->pinhole.fx - 1.0);
    centers.push_back((made.color.cx - nominal.color.cx) / nominal.color.width);
    centers.push_back((made.color.cy - nominal.color.cy) / nominal.color.width);
  }
  expectGaussianSample(shifts_m, 0.01);
  // The three parts of a turn share its angle, whose squares thus count once.
  expectGaussianSample(turns_rad, 0.5 * kRadPerDeg, kSeeds);
  expectGaussianSample(color_focals, 0.005);
  expectGaussianSample(depth_focals, 0.005);
  expectGaussianSample(centers, 0.005);
}

}  // namespace
}  // namespace oikos::simulate
