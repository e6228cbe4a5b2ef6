// SPDX-License-Identifier: Apache-2.0
#include "tests/support/analytic_room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

namespace oikos::test {

namespace {

constexpr std::array<unsigned char, 3> kBrown = {120, 80, 40};

struct Interval {
  double enter;
  double leave;
  int leave_axis;
};

/// Where a ray's line is inside a box.
Interval intersect(const AnalyticBox& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  Interval inside{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0};
  for (int a = 0; a < 3; ++a) {
    const double t1 = (box.min_map[a] - origin[a]) / direction[a];
    const double t2 = (box.max_map[a] - origin[a]) / direction[a];
    inside.enter = std::max(inside.enter, std::min(t1, t2));
    if (std::max(t1, t2) < inside.leave) {
      inside.leave = std::max(t1, t2);
      inside.leave_axis = a;
    }
  }
  return inside;
}

double distanceToBoxSurface(const AnalyticBox& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d outside = (box.min_map - point).cwiseMax(point - box.max_map);
  return outside.maxCoeff() > 0.0 ? outside.cwiseMax(0.0).norm() : -outside.maxCoeff();
}

}  // namespace

AnalyticRoom AnalyticRoom::furnished() {
  return AnalyticRoom({{-2.0, -1.5, 0.0}, {2.0, 1.5, 2.5}, {200, 200, 200}},
                      {{{0.6, -0.8, 0.0}, {1.4, 0.8, 0.75}, {220, 30, 30}}, {{-1.9, 0.7, 0.0}, {-1.3, 1.4, 0.4}, {30, 30, 220}}});
}

AnalyticRoom::Hit AnalyticRoom::castRay(const Eigen::Vector3d& origin_map, const Eigen::Vector3d& direction_map) const {
  const Interval room = intersect(room_, origin_map, direction_map);
  const bool is_floor = room.leave_axis == 2 && direction_map.z() < 0.0;
  Hit hit{room.leave, is_floor ? kBrown : room_.rgb};
  for (const AnalyticBox& box : furniture_) {
    const Interval inside = intersect(box, origin_map, direction_map);
    if (inside.enter > 0.0 && inside.enter < inside.leave && inside.enter < hit.distance_m) {
      hit = {inside.enter, box.rgb};
    }
  }
  return hit;
}

camera::RgbdFrame AnalyticRoom::render(const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) const {
  camera::RgbdFrame frame;
  frame.color.create(camera.height, camera.width, CV_8UC3);
  frame.gray.create(camera.height, camera.width, CV_8UC1);
  frame.depth_m.create(camera.height, camera.width, CV_32FC1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Hit hit = castRay(T_map_camera.translation(), T_map_camera.linear() * camera.ray(u, v));
      frame.depth_m.at<float>(v, u) = static_cast<float>(hit.distance_m);
      frame.color.at<cv::Vec3b>(v, u) = cv::Vec3b(hit.rgb[2], hit.rgb[1], hit.rgb[0]);
      frame.gray.at<unsigned char>(v, u) = static_cast<unsigned char>((hit.rgb[0] + hit.rgb[1] + hit.rgb[2]) / 3);
    }
  }
  return frame;
}

double AnalyticRoom::distanceToSurface(const Eigen::Vector3d& point_map) const {
  double distance = distanceToBoxSurface(room_, point_map);
  for (const AnalyticBox& box : furniture_) {
    distance = std::min(distance, distanceToBoxSurface(box, point_map));
  }
  return distance;
}

camera::PinholeCamera smallCamera() {
  return {160, 120, 138.6, 138.6, 79.5, 59.5};
}

Eigen::Isometry3d lookAt(const Eigen::Vector3d& position_map, const Eigen::Vector3d& target_map) {
  const Eigen::Vector3d forward = (target_map - position_map).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.linear().col(0) = right;
  T_map_camera.linear().col(1) = forward.cross(right);
  T_map_camera.linear().col(2) = forward;
  T_map_camera.translation() = position_map;
  return T_map_camera;
}

std::vector<Eigen::Isometry3d> lookAround(int count, double radius_m, double height_m, double tilt_rad) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i) {
    const double yaw = 2.0 * std::numbers::pi * i / count;
    const Eigen::Vector3d outwards(std::cos(yaw), std::sin(yaw), 0.0);
    const Eigen::Vector3d position = radius_m * outwards + height_m * Eigen::Vector3d::UnitZ();
    poses.push_back(lookAt(position, position + outwards - std::tan(tilt_rad) * Eigen::Vector3d::UnitZ()));
  }
  return poses;
}

}  // namespace oikos::test
