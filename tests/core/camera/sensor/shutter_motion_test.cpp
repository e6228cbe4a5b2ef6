// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/shutter_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

namespace oikos::camera {
namespace {

constexpr PinholeCamera kCamera = {320, 240, 300.0, 300.0, 159.5, 119.5};
constexpr double kDepth_m = 2.0;
constexpr double kExposure_s = 0.02;

/// Dark left of column 160, bright from there on: the edge is at 159.5.
cv::Mat edgeLight() {
  cv::Mat light(240, 320, CV_32FC4, cv::Scalar(0.0, 0.0, 0.0, 0.0));
  light.colRange(160, 320) = cv::Scalar(1.0, 1.0, 1.0, 0.0);
  return light;
}

cv::Mat evenDepth(double depth_m) {
  return cv::Mat(240, 320, CV_32FC1, cv::Scalar(depth_m));
}

std::vector<float> warpRow(const ShutterMotion& motion, const cv::Mat& light, const cv::Mat& depth_m, int v) {
  std::vector<float> row(4 * 320);
  ShutterWarp(kCamera, motion, {kExposure_s, 32}).fillRow(light, depth_m, v, row.data());
  return row;
}

struct Edge {
  double place_px = 0.0;  ///< where the light would rise at once
  double width_px = 0.0;  ///< of a uniform rise with the same deviation
};

/// From the moments of the rise.
Edge measureEdge(const std::vector<float>& row) {
  double sum = 0.0;
  double sum_u = 0.0;
  double sum_sq = 0.0;
  for (std::size_t u = 1; u < row.size() / 4; ++u) {
    const double rise = static_cast<double>(row[4 * u] - row[4 * u - 4]);
    const double at = static_cast<double>(u) - 0.5;
    sum += rise;
    sum_u += rise * at;
    sum_sq += rise * at * at;
  }
  EXPECT_NEAR(sum, 1.0, 1e-4);
  return {sum_u, std::sqrt(12.0 * std::max(0.0, sum_sq - sum_u * sum_u))};
}

geometry::Vector6d twist(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn) {
  geometry::Vector6d result;
  result << velocity, turn;
  return result;
}

TEST(ShutterWarp, AStillCameraChangesNothing) {
  const std::vector<float> row = warpRow({}, edgeLight(), evenDepth(kDepth_m), 100);
  for (std::size_t u = 0; u < 320; ++u) {
    ASSERT_NEAR(row[4 * u], u < 160 ? 0.0F : 1.0F, 1e-3F) << u;
  }
}

class Speeds : public testing::TestWithParam<double> {};

TEST_P(Speeds, AnEdgeIsBlurredByTheFlowOfATranslation) {
  const double speed = GetParam();
  ShutterMotion motion;
  motion.twist_camera = twist({speed, 0.0, 0.0}, Eigen::Vector3d::Zero());
  const Edge edge = measureEdge(warpRow(motion, edgeLight(), evenDepth(kDepth_m), 100));
  const double flow_px = kCamera.fx * speed * kExposure_s / kDepth_m;
  EXPECT_NEAR(edge.place_px, 159.5, 0.05);
  // interpolation has made the edge a pixel wide itself
  EXPECT_NEAR(std::sqrt(std::max(0.0, edge.width_px * edge.width_px - 1.0)), flow_px, 0.02 * flow_px + 0.1);
}

INSTANTIATE_TEST_SUITE_P(MetresPerSecond, Speeds, testing::Values(1.0, 2.0, 4.0, 8.0));

TEST(ShutterWarp, ATurnBlursEveryDepthAlike) {
  ShutterMotion motion;
  motion.twist_camera = twist(Eigen::Vector3d::Zero(), {0.0, 2.0, 0.0});
  const double flow_px = kCamera.fx * 2.0 * kExposure_s;
  for (const double depth_m : {0.5, 5.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Edge edge = measureEdge(warpRow(motion, edgeLight(), evenDepth(depth_m), 119));
    EXPECT_NEAR(edge.width_px, flow_px, 0.02 * flow_px);
  }
}

TEST(ShutterWarp, ARollingShutterShearsAnEdge) {
  constexpr double kReadout_s = 0.03;
  constexpr double kSpeed = 2.0;
  ShutterMotion motion = makeSteadyMotion(twist({kSpeed, 0.0, 0.0}, Eigen::Vector3d::Zero()), kReadout_s, 240);
  motion.twist_camera.setZero();  // no blur
  for (const int v : {0, 60, 180, 239}) {
    const Edge edge = measureEdge(warpRow(motion, edgeLight(), evenDepth(kDepth_m), v));
    const double since_mid_s = kReadout_s * (v / 239.0 - 0.5);
    // the camera goes to the right, so the edge goes to the left
    EXPECT_NEAR(edge.place_px, 159.5 - kCamera.fx * kSpeed * since_mid_s / kDepth_m, 0.02) << v;
  }
}

TEST(ShutterWarp, ARollingShutterUnderATurnFollowsTheTangent) {
  constexpr double kReadout_s = 0.03;
  ShutterMotion motion = makeSteadyMotion(twist(Eigen::Vector3d::Zero(), {0.0, 3.0, 0.0}), kReadout_s, 240);
  motion.twist_camera.setZero();
  for (const int v : {0, 239}) {
    const Edge edge = measureEdge(warpRow(motion, edgeLight(), evenDepth(kDepth_m), v));
    // the camera turns to the right
    EXPECT_NEAR(edge.place_px, 159.5 - kCamera.fx * std::tan(3.0 * kReadout_s * (v / 239.0 - 0.5)), 0.1) << v;
  }
}

TEST(ShutterWarp, NearThingsMoveMore) {
  cv::Mat depth_m = evenDepth(kDepth_m);
  depth_m.rowRange(0, 120) = cv::Scalar(0.5 * kDepth_m);
  ShutterMotion motion;
  motion.twist_camera = twist({3.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
  const double near_px = measureEdge(warpRow(motion, edgeLight(), depth_m, 50)).width_px;
  const double far_px = measureEdge(warpRow(motion, edgeLight(), depth_m, 200)).width_px;
  EXPECT_NEAR(near_px / far_px, 2.0, 0.1);
}

TEST(SteadyMotion, TheMiddleRowIsAtMid) {
  const ShutterMotion motion = makeSteadyMotion(twist({1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}), 0.02, 241);
  ASSERT_EQ(motion.T_mid_row.size(), 241U);
  EXPECT_TRUE(motion.T_mid_row[120].isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  EXPECT_TRUE((motion.T_mid_row[0] * motion.T_mid_row[240]).isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  EXPECT_TRUE(makeSteadyMotion(twist({1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}), 0.0, 241).T_mid_row.empty());
}

}  // namespace
}  // namespace oikos::camera
