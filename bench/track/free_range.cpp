// SPDX-License-Identifier: Apache-2.0
#include "bench/track/free_range.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/degrees.h"
#include "semantic/history/home_state.h"
#include "semantic/model/home_models.h"
#include "tracking/furniture/changed_pieces.h"

namespace oikos::bench {

namespace {

constexpr double kSpacing_m = 0.05;   // of the points of a part that are tried
constexpr double kTouching_m = 0.01;  // deep: more is a collision

/// A piece as something in the way.
struct Obstacle {
  std::string id;
  Eigen::Isometry3d T_map_object = Eigen::Isometry3d::Identity();
  Eigen::AlignedBox3d box_object;
};

std::vector<Eigen::Vector3d> pointsOf(const model::TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& triangle : mesh.triangles) {
    for (int side = 0; side < 3; ++side) {
      const Eigen::Vector3d a = mesh.vertices[static_cast<std::size_t>(triangle.at(static_cast<std::size_t>(side)))].cast<double>();
      const Eigen::Vector3d b = mesh.vertices[static_cast<std::size_t>(triangle[(side + 1) % 3])].cast<double>();
      const int steps = std::max(1, static_cast<int>((b - a).norm() / kSpacing_m));
      for (int i = 0; i < steps; ++i) {
        points.emplace_back(a + (b - a) * i / steps);
      }
    }
  }
  return points;
}

bool isBlocked(const Eigen::Vector3d& point_map, const semantic::Room& room, const std::vector<Obstacle>& obstacles,
               const std::string& own) {
  std::vector<cv::Point2f> outline;
  for (const Eigen::Vector2d& corner : room.outline_map) {
    outline.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
  }
  const cv::Point2f at(static_cast<float>(point_map.x()), static_cast<float>(point_map.y()));
  if (cv::pointPolygonTest(outline, at, true) < -kTouching_m) {
    return true;
  }
  return std::any_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& obstacle) {
    const Eigen::Vector3d inside = obstacle.T_map_object.inverse() * point_map;
    return obstacle.id != own && ((inside - obstacle.box_object.min()).array() > kTouching_m).all() &&
           ((obstacle.box_object.max() - inside).array() > kTouching_m).all();
  });
}

double freeUpperOf(const semantic::LargeObject& object, std::size_t joint, const model::ArticulatedModel& model, const semantic::Room& room,
                   const std::vector<Obstacle>& obstacles) {
  const model::ModelJoint& moving = model.joints[joint];
  const bool turns = moving.type == model::MotionType::kRevolute;
  const double step = turns ? base::kRadPerDeg : 0.01;
  const model::Kinematics kinematics(model);
  const auto part = static_cast<std::size_t>(moving.child);
  const std::vector<Eigen::Vector3d> points_part = pointsOf(*model.parts[part].mesh_part);
  std::vector<double> values = semantic::jointValues(object);
  const int steps = static_cast<int>(std::floor(moving.upper / step + 1e-9));
  double free = 0.0;
  for (int i = 1; i <= steps; ++i) {
    values[joint] = i * step;
    const Eigen::Isometry3d T_map_part = object.T_map_object.toIsometry() * kinematics.solve(values)[part];
    const bool is_blocked = std::any_of(points_part.begin(), points_part.end(), [&](const Eigen::Vector3d& point_part) {
      return isBlocked(T_map_part * point_part, room, obstacles, object.id.value);
    });
    if (is_blocked) {
      break;
    }
    free = values[joint];
  }
  return turns ? free / base::kRadPerDeg : free;
}

}  // namespace

std::map<std::string, double> freeUppers(const std::filesystem::path& home_folder) {
  const semantic::Home home = semantic::loadHome(home_folder);
  semantic::ModelMaker maker(home_folder);
  std::map<std::string, double> uppers;
  for (const semantic::Room& room : home.rooms) {
    std::vector<Obstacle> obstacles;
    for (const semantic::LargeObject& object : room.objects) {
      obstacles.push_back(
          {object.id.value, object.T_map_object.toIsometry(), tracking::boxOf(maker.make(object), {semantic::jointValues(object)})});
    }
    for (const semantic::LargeObject& object : room.objects) {
      const std::size_t joints = object.articulation && object.type != "door" ? object.articulation->joints.size() : 0;
      for (std::size_t joint = 0; joint < joints; ++joint) {
        uppers[object.articulation->joints[joint].id.value] = freeUpperOf(object, joint, maker.make(object), room, obstacles);
      }
    }
  }
  return uppers;
}

}  // namespace oikos::bench
