// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/landmark_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "mapping/odometry/corner_detector.h"
#include "tests/support/textured_recording.h"
#include "tests/support/textured_world.h"

namespace oikos::mapping {
namespace {

using geometry::Vector6d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTolerance_m = 0.002;  ///< a tenth of a pixel at 266 px and 3 m is 1 mm
constexpr double kTolerance_rad = 0.05 * kDegree;

Vector6d twist(double x, double y, double z, double rx, double ry, double rz) {
  Vector6d xi;
  xi << x, y, z, rx, ry, rz;
  return xi;
}

/// An image with its pyramid.
struct View {
  explicit View(camera::RgbdFrame rgbd) : frame(std::move(rgbd)), pyramid(frame.gray, 5) {}
  camera::RgbdFrame frame;
  ImagePyramid pyramid;
};

class LandmarkFollowerTest : public ::testing::Test {
 protected:
  LandmarkFollowerTest() {
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      candidates_.push_back({static_cast<int>(i), &landmarks_[i], T_map_host_, &host_.pyramid});
    }
  }

  [[nodiscard]] View viewFrom(const Eigen::Isometry3d& T_map_camera) const { return View(world_.render(camera_, T_map_camera)); }
  [[nodiscard]] TargetView target(const View& view) const { return {&camera_, &view.pyramid, &view.frame.depth_m}; }

  void expectPose(const PoseSolution& pose, const Eigen::Isometry3d& T_map_camera, double allowance = 1.0) const {
    const Vector6d error = geometry::logSe3(T_map_camera.inverse() * pose.T_world_camera);
    EXPECT_LT(error.head<3>().norm(), allowance * kTolerance_m);
    EXPECT_LT(error.tail<3>().norm(), allowance * kTolerance_rad);
  }

  const test::TexturedWorld world_ = test::TexturedWorld::furnished();
  const camera::PinholeCamera camera_ = test::texturedCamera();
  const Eigen::Isometry3d T_map_host_ = test::lookAt({-1.2, 0.1, 1.3}, {1.0, 0.0, 0.6});
  const Eigen::Isometry3d T_map_moved_ = T_map_host_ * geometry::expSe3(twist(0.10, 0.04, 0.12, 0.02, -0.06, 0.05));
  const View host_{world_.render(camera_, T_map_host_)};
  const std::vector<Landmark> landmarks_ = detectCorners(host_.frame, {}, {});
  std::vector<Candidate> candidates_;
  const FollowerConfig config_;
};

TEST_F(LandmarkFollowerTest, FindsThePoseOfTheHostItself) {
  ASSERT_GT(landmarks_.size(), 100U);
  const FollowResult result = followLandmarks(target(host_), candidates_, T_map_host_, config_);
  ASSERT_TRUE(result.tracked);
  expectPose(result.pose, T_map_host_, 0.1);
  EXPECT_GT(result.found, 0.95 * result.in_view);
  EXPECT_EQ(static_cast<int>(result.observations.size()), result.pose.inliers);
}

TEST_F(LandmarkFollowerTest, FindsTheMovedCameraFromWrongStarts) {
  const View moved = viewFrom(T_map_moved_);
  for (const Vector6d& off : {twist(0, 0, 0, 0, 0, 0), twist(0.03, -0.02, 0.03, 0, 0, 0), twist(0, 0, 0, 0.02, -0.03, 0.02),
                              twist(-0.03, 0.02, -0.03, -0.02, 0.02, -0.03)}) {
    const FollowResult result = followLandmarks(target(moved), candidates_, T_map_moved_ * geometry::expSe3(off), config_);
    ASSERT_TRUE(result.tracked) << off.transpose();
    EXPECT_EQ(result.pose.status, PoseStatus::kConverged);
    expectPose(result.pose, T_map_moved_);
    EXPECT_GE(result.in_view, result.found);
    EXPECT_GE(result.found, result.pose.inliers);
    EXPECT_GT(result.pose.inliers, 0.7 * result.in_view);
  }
}

TEST_F(LandmarkFollowerTest, ObservationsAreWhereThePointsProject) {
  const View moved = viewFrom(T_map_moved_);
  const FollowResult result = followLandmarks(target(moved), candidates_, T_map_moved_, config_);
  ASSERT_TRUE(result.tracked);
  std::vector<double> errors_px;
  int previous = -1;
  for (const Observation& seen : result.observations) {
    const Landmark& landmark = landmarks_[static_cast<std::size_t>(seen.landmark)];
    const Eigen::Vector3d p = T_map_moved_.inverse() * T_map_host_ * pointInHost(landmark, camera_);
    errors_px.push_back((camera_.project(p) - seen.pixel.cast<double>()).norm());
    EXPECT_GT(seen.landmark, previous) << "not in the candidates' order";
    previous = seen.landmark;
    const float depth_m = moved.frame.depth_m.at<float>(static_cast<int>(seen.pixel.y() + 0.5F), static_cast<int>(seen.pixel.x() + 0.5F));
    EXPECT_EQ(seen.depth_m, Eigen::half(depth_m));
    EXPECT_GE(seen.level, 0);
  }
  std::sort(errors_px.begin(), errors_px.end());
  EXPECT_LT(errors_px[errors_px.size() / 2], 0.1);
  EXPECT_LT(errors_px[errors_px.size() * 95 / 100], 0.5);
}

TEST_F(LandmarkFollowerTest, NoiseCostsLittle) {
  const test::SyntheticRecording noisy(world_, camera_, {T_map_moved_}, {.gray_sigma = 4.0, .depth_sigma_scale = 1.0});
  const View moved(noisy.read(0, recording::Channels::kGray));
  const FollowResult result = followLandmarks(target(moved), candidates_, T_map_moved_, config_);
  ASSERT_TRUE(result.tracked);
  expectPose(result.pose, T_map_moved_, 2.0);
  const Vector6d xi = geometry::logSe3(T_map_moved_.inverse() * result.pose.T_world_camera);
  EXPECT_LT(xi.dot(result.pose.covariance.ldlt().solve(xi)), 30.0);  // of six degrees of freedom
}

TEST_F(LandmarkFollowerTest, WorksWithoutDepth) {
  const View moved = viewFrom(T_map_moved_);
  const FollowResult result = followLandmarks({&camera_, &moved.pyramid, nullptr}, candidates_, T_map_moved_, config_);
  ASSERT_TRUE(result.tracked);
  expectPose(result.pose, T_map_moved_);
  EXPECT_TRUE(std::isnan(static_cast<float>(result.observations.front().depth_m)));
}

TEST_F(LandmarkFollowerTest, ASeenAgainSmallerOrLargerSurfaceIsFollowed) {
  for (const double forward_m : {0.5, -0.4}) {
    const Eigen::Isometry3d T_map_far = T_map_host_ * geometry::expSe3(twist(0.0, 0.0, forward_m, 0.0, 0.0, 0.1));
    const View view = viewFrom(T_map_far);
    const FollowResult result =
        followLandmarks(target(view), candidates_, T_map_far * geometry::expSe3(twist(0.01, 0.01, -0.02, 0, 0.01, 0)), config_);
    ASSERT_TRUE(result.tracked) << forward_m;
    expectPose(result.pose, T_map_far, 2.0);
  }
}

TEST_F(LandmarkFollowerTest, ACoveredLensIsLost) {
  const test::SyntheticRecording recording(world_, camera_, {T_map_moved_}, {.blank_frames = {0}});
  const View blank(recording.read(0, recording::Channels::kGray));
  const FollowResult result = followLandmarks(target(blank), candidates_, T_map_moved_, config_);
  EXPECT_FALSE(result.tracked);
  EXPECT_TRUE(result.observations.empty());
  EXPECT_EQ(result.found, 0);
  EXPECT_GT(result.in_view, 50);
  EXPECT_EQ(result.pose.status, PoseStatus::kTooFewSightings);
}

TEST_F(LandmarkFollowerTest, AnotherPlaceIsLost) {
  const View elsewhere(test::TexturedWorld::furnished(77).render(camera_, T_map_moved_));
  EXPECT_FALSE(followLandmarks(target(elsewhere), candidates_, T_map_moved_, config_).tracked);
}

TEST_F(LandmarkFollowerTest, OutOfViewIsLost) {
  const Eigen::Isometry3d T_map_back = T_map_host_ * geometry::expSe3(twist(0, 0, 0, 0, std::numbers::pi, 0));
  const View back = viewFrom(T_map_back);
  const FollowResult result = followLandmarks(target(back), candidates_, T_map_back, config_);
  EXPECT_FALSE(result.tracked);
  EXPECT_EQ(result.in_view, 0);
}

TEST_F(LandmarkFollowerTest, NoCandidatesIsLost) {
  const FollowResult result = followLandmarks(target(host_), {}, T_map_host_, config_);
  EXPECT_FALSE(result.tracked);
  EXPECT_EQ(result.in_view, 0);
  EXPECT_TRUE(result.pose.T_world_camera.isApprox(T_map_host_));
}

TEST_F(LandmarkFollowerTest, TooFewInliersIsLost) {
  const std::vector<Candidate> few(candidates_.begin(), candidates_.begin() + 20);
  const FollowResult result = followLandmarks(target(host_), few, T_map_host_, config_);
  EXPECT_EQ(result.pose.status, PoseStatus::kConverged);
  EXPECT_FALSE(result.tracked);
}

TEST_F(LandmarkFollowerTest, WrongDepthsAreLeftOut) {
  std::vector<Landmark> wrong = landmarks_;
  for (std::size_t i = 0; i < wrong.size(); i += 4) {
    wrong[i].inverse_depth *= 1.3;
  }
  std::vector<Candidate> candidates = candidates_;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].value = &wrong[i];
  }
  const View moved = viewFrom(T_map_moved_);
  const FollowResult result = followLandmarks(target(moved), candidates, T_map_moved_, config_);
  ASSERT_TRUE(result.tracked);
  expectPose(result.pose, T_map_moved_, 2.0);
  const auto believed =
      std::count_if(result.observations.begin(), result.observations.end(), [](const Observation& seen) { return seen.landmark % 4 == 0; });
  EXPECT_LT(believed, 0.1 * static_cast<double>(result.observations.size()));
}

TEST_F(LandmarkFollowerTest, FindLandmarksFromAKnownPose) {
  const View moved = viewFrom(T_map_moved_);
  const auto seen = findLandmarks(target(moved), candidates_, T_map_moved_, 2.0, config_);
  EXPECT_GT(seen.size(), candidates_.size() / 2);
  for (const Observation& observation : seen) {
    const Landmark& landmark = landmarks_[static_cast<std::size_t>(observation.landmark)];
    const Eigen::Vector3d p = T_map_moved_.inverse() * T_map_host_ * pointInHost(landmark, camera_);
    EXPECT_LT((camera_.project(p) - observation.pixel.cast<double>()).norm(), 2.0);
    EXPECT_EQ(observation.level, 0);
  }
}

TEST_F(LandmarkFollowerTest, FindLandmarksKeepsToItsGate) {
  const View moved = viewFrom(T_map_moved_);
  // One degree is 4.6 pixels: every patch is farther from where it should be than the gate.
  const Eigen::Isometry3d T_map_off = T_map_moved_ * geometry::expSe3(twist(0, 0, 0, 0, 1.0 * kDegree, 0));
  EXPECT_LT(findLandmarks(target(moved), candidates_, T_map_off, 2.0, config_).size(), candidates_.size() / 50);
  EXPECT_GT(findLandmarks(target(moved), candidates_, T_map_off, 8.0, config_).size(), candidates_.size() / 3);
}

}  // namespace
}  // namespace oikos::mapping
