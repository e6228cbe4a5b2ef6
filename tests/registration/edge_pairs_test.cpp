// SPDX-License-Identifier: Apache-2.0
#include "registration/edge_pairs.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "core/model/primitives.h"
#include "tests/registration/furniture_scan.h"

namespace oikos::registration {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Depth of a board of 0.8 m × 0.6 m that faces the camera at 2 m, moved by `right_m`, before a wall at 3 m.
cv::Mat boardDepth(double right_m) {
  const camera::PinholeCamera camera = test::kinectCamera();
  cv::Mat depth_m(camera.height, camera.width, CV_32FC1, cv::Scalar(3.0));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d point = 2.0 * camera.ray(u, v);
      if (std::abs(point.x() - right_m) < 0.4 && std::abs(point.y()) < 0.3) {
        depth_m.at<float>(v, u) = 2.0F;
      }
    }
  }
  return depth_m;
}

struct BoardView {
  render::Scene scene;
  render::View view;
  BoardView() {
    scene.add(std::make_shared<const model::TriangleMesh>(model::makeBox({0.8F, 0.6F, 0.02F})),
              Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 2.01)));
    scene.commit();
    view = test::viewOf(scene, thinned(test::kinectCamera(), 4));
  }
};

std::vector<Pair> edgePairs(const cv::Mat& depth_m, double gate_m = 0.2) {
  const Scan scan = makeScan(depth_m, test::kinectCamera(), {});
  std::vector<Pair> pairs;
  appendEdgePairs(BoardView().view, scan, ScanEdges(scan), Eigen::Isometry3d::Identity(), gate_m, pairs);
  return pairs;
}

TEST(EdgePairs, ResidualIsTheShiftAcrossTheOutline) {
  constexpr double kShift_m = 0.06;
  const double pixel_m = 2.0 / 131.25;
  int across = 0;
  int along = 0;
  for (const Pair& pair : edgePairs(boardDepth(kShift_m))) {
    EXPECT_TRUE(pair.is_edge);
    if (std::abs(pair.normal_map.x()) > 0.9) {
      EXPECT_NEAR(pair.residual_m(), pair.normal_map.x() > 0.0 ? kShift_m : -kShift_m, pixel_m);
      ++across;
    } else if (std::abs(pair.normal_map.y()) > 0.9) {
      EXPECT_NEAR(pair.residual_m(), 0.0, pixel_m);
      ++along;
    }
  }
  EXPECT_GT(across, 60);
  EXPECT_GT(along, 80);
}

/// A projector leaves a shadow without readings beside a near edge: the jump is seen past it.
TEST(EdgePairs, LookPastAShadow) {
  cv::Mat depth_m = boardDepth(0.0);
  const auto left = static_cast<int>(319.5 - 0.4 / 2.0 * 525.0);
  depth_m.colRange(left - 14, left + 1).setTo(kNan);
  const auto pairs = edgePairs(depth_m);
  EXPECT_GT(std::count_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.normal_map.x() < -0.9; }), 25);
}

TEST(EdgePairs, ThereAreNoneWhereTheScanDoesNotJump) {
  EXPECT_TRUE(edgePairs(cv::Mat(480, 640, CV_32FC1, cv::Scalar(2.0))).empty());
  EXPECT_TRUE(edgePairs(cv::Mat(480, 640, CV_32FC1, cv::Scalar(kNan))).empty());
  EXPECT_TRUE(edgePairs(boardDepth(0.5), 0.1).empty() ||
              edgePairs(boardDepth(0.5), 0.1).size() < 110);  // out of reach but for the long sides
}

/// The wall's edge around a hole jumps the other way.
TEST(EdgePairs, AJumpTheOtherWayIsNone) {
  cv::Mat hole(480, 640, CV_32FC1, cv::Scalar(2.0));
  cv::Mat board = boardDepth(0.0);
  hole.setTo(3.0, board < 2.5F);
  for (const Pair& pair : edgePairs(hole, 0.02)) {
    ADD_FAILURE() << pair.normal_map.transpose();
  }
}

}  // namespace
}  // namespace oikos::registration
