// SPDX-License-Identifier: Apache-2.0
#include "core/camera/depth_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/error.h"

namespace oikos::camera {
namespace {

constexpr double kNear_m = 0.8;
constexpr double kFar_m = 2.5;

/// A near board, |x| and |y| below its half size, before a far wall; both at right angles to the colour camera's axis.
struct Board {
  double half_width_m = 0.2;
  double half_height_m = 0.15;
  [[nodiscard]] bool covers(const Eigen::Vector3d& point, double margin_m) const {
    return std::abs(point.x()) < half_width_m + margin_m && std::abs(point.y()) < half_height_m + margin_m;
  }
};

/// Depth along the axis of the depth camera (in which T_color_depth has no rotation about x and y) that it sees at a pixel.
double seenDepth(const DepthCamera& depth, const Board& board, int u, int v) {
  const Eigen::Vector3d ray = depth.T_color_depth.linear() * depth.pinhole.ray(u, v);
  const Eigen::Vector3d origin = depth.T_color_depth.translation();
  const double near_scale = (kNear_m - origin.z()) / ray.z();
  const bool on_board = board.covers(origin + near_scale * ray, 0.0);
  return on_board ? near_scale : (kFar_m - origin.z()) / ray.z();
}

struct World {
  const char* name;
  Calibration calibration;
};

World makeWorld(const char* name, double depth_size, const Eigen::Vector3d& t_color_depth, double roll_rad, double ratio = 1.0) {
  World world{name, {}};
  world.calibration.color = {320, 240, 262.0, 262.0, 160.2, 119.4};
  world.calibration.depth_scale = 10000.0;
  const double f = 262.0 * depth_size * ratio;
  DepthCamera depth;
  depth.pinhole = {static_cast<int>(320 * depth_size), static_cast<int>(240 * depth_size), f, f, 160 * depth_size, 120 * depth_size};
  depth.T_color_depth = Eigen::Translation3d(t_color_depth) * Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ());
  world.calibration.depth = depth;
  return world;
}

/// A wall that the camera reads wrongly by a share that depends on distance and place is where it is again.
TEST(DepthCorrection, AWallThatIsReadWronglyIsMadeEven) {
  Calibration calibration = makeWorld("corrected", 1.0, {0.0, 0.0, 0.0}, 0.0).calibration;
  calibration.depth->correction = {0.01, -0.004, 0.02, -0.03};
  const DepthCorrection& c = calibration.depth->correction;
  cv::Mat stored(240, 320, CV_16UC1);
  for (int v = 0; v < stored.rows; ++v) {
    for (int u = 0; u < stored.cols; ++u) {
      const Eigen::Vector3d ray = calibration.depth->pinhole.ray(u, v);
      const double b = 1.0 + c.constant + c.across * ray.x() + c.down * ray.y();
      const double reading_m = 2.0 * kFar_m / (b + std::sqrt(b * b + 4.0 * c.per_m * kFar_m));  // z (b + per_m z) = far
      stored.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(std::lround(reading_m * 10000.0));
    }
  }
  stored.at<std::uint16_t>(100, 100) = 0;
  const cv::Mat depth_m = DepthRegistration(calibration, Rectifier(calibration.color, {})).toMetres(stored);
  int readings = 0;
  for (int v = 20; v < depth_m.rows - 20; ++v) {
    for (int u = 20; u < depth_m.cols - 20; ++u) {
      if (!std::isnan(depth_m.at<float>(v, u))) {
        ASSERT_NEAR(depth_m.at<float>(v, u), kFar_m, 1e-4) << u << "," << v;
        ++readings;
      }
    }
  }
  EXPECT_GT(readings, 50000);
}

class Splatting : public testing::TestWithParam<World> {};

TEST_P(Splatting, TheFarWallNeverShowsThroughTheBoard) {
  const Calibration& calibration = GetParam().calibration;
  const DepthCamera& camera = *calibration.depth;
  const Board board;
  cv::Mat stored(camera.pinhole.height, camera.pinhole.width, CV_16UC1);
  for (int v = 0; v < stored.rows; ++v) {
    for (int u = 0; u < stored.cols; ++u) {
      stored.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(std::lround(seenDepth(camera, board, u, v) * 10000.0));
    }
  }
  const cv::Mat depth_m = DepthRegistration(calibration, Rectifier(calibration.color, {})).toMetres(stored);
  // the edge of the board is known to one pixel of the coarser of the two cameras, on the board
  const double coarsest_px = std::min(calibration.color.fx, camera.pinhole.fx);
  const double edge_m = 1.5 * kNear_m / coarsest_px;
  int inside = 0;
  int outside = 0;
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const float depth = depth_m.at<float>(v, u);
      const Eigen::Vector3d on_board = calibration.color.ray(u, v) * kNear_m;
      if (board.covers(on_board, -edge_m)) {
        ASSERT_NEAR(depth, kNear_m, 1e-4) << u << "," << v;
        ++inside;
      } else if (!board.covers(on_board, edge_m)) {
        ASSERT_TRUE(std::isnan(depth) || std::abs(depth - kFar_m) < 1e-3) << u << "," << v << ": " << depth;
        outside += std::isnan(depth) ? 0 : 1;
      }
    }
  }
  EXPECT_GT(inside, 5000);
  EXPECT_GT(outside, 20000);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, Splatting,
    testing::Values(makeWorld("same", 1.0, {-0.03, 0.008, 0.0}, 0.0), makeWorld("kinect", 1.0, {-0.03, 0.008, 0.0}, 0.0, 585.0 / 525.5),
                    makeWorld("smaller", 0.5, {-0.03, 0.008, 0.0}, 0.0), makeWorld("tiny", 0.2, {0.05, 0.0, 0.0}, 0.0),
                    makeWorld("larger", 2.0, {-0.03, 0.008, 0.0}, 0.0), makeWorld("wide", 0.8, {0.0, 0.06, 0.0}, 0.0, 0.7),
                    makeWorld("rolled", 1.0, {-0.03, 0.01, 0.0}, 0.2), makeWorld("before", 1.0, {0.02, 0.0, 0.06}, 0.0),
                    makeWorld("behind", 1.0, {0.02, 0.0, -0.06}, 0.0)),
    [](const auto& world) { return std::string(world.param.name); });

TEST(DepthRegistration, NoReadingAndScale) {
  Calibration calibration;
  calibration.color = {16, 8, 10.0, 10.0, 7.5, 3.5};
  calibration.depth_scale = 5000.0;
  cv::Mat stored(8, 16, CV_16UC1, cv::Scalar(5000));
  stored.at<std::uint16_t>(1, 1) = 0;
  stored.at<std::uint16_t>(2, 2) = 65535;
  stored.at<std::uint16_t>(3, 3) = 65534;
  const cv::Mat depth_m = DepthRegistration(calibration, Rectifier(calibration.color, {})).toMetres(stored);
  EXPECT_FLOAT_EQ(depth_m.at<float>(0, 0), 1.0F);
  EXPECT_TRUE(std::isnan(depth_m.at<float>(1, 1)));
  EXPECT_TRUE(std::isnan(depth_m.at<float>(2, 2)));
  EXPECT_FLOAT_EQ(depth_m.at<float>(3, 3), 65534.0F / 5000.0F);
}

TEST(DepthRegistration, SeparateCameraKeepsNoReadingApart) {
  const Calibration calibration = makeWorld("", 1.0, {-0.03, 0.0, 0.0}, 0.0).calibration;
  cv::Mat stored(240, 320, CV_16UC1, cv::Scalar(0));
  stored.at<std::uint16_t>(120, 160) = 65535;
  const cv::Mat depth_m = DepthRegistration(calibration, Rectifier(calibration.color, {})).toMetres(stored);
  EXPECT_EQ(cv::countNonZero(depth_m == depth_m), 0);
}

TEST(DepthRegistration, WrongSizeIsABug) {
  const Calibration calibration = makeWorld("", 0.5, {0.0, 0.0, 0.0}, 0.0).calibration;
  const DepthRegistration registration(calibration, Rectifier(calibration.color, {}));
  EXPECT_THROW((void)registration.toMetres(cv::Mat(240, 320, CV_16UC1)), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::camera
