// SPDX-License-Identifier: Apache-2.0
#include "mapping/map_frame.h"

#include <cmath>

namespace oikos::mapping {

Eigen::Isometry3d mapFrame(const FloorResult& floor, const Eigen::Isometry3d& T_world_first_camera,
                           const std::optional<Eigen::Isometry3d>& T_base_camera) {
  if (!T_base_camera) {
    return floor.T_map_world;
  }
  const Eigen::Isometry3d T_world_base = T_world_first_camera * T_base_camera->inverse();
  if (floor.status != FloorStatus::kFound) {
    return T_world_base.inverse();
  }
  const Eigen::Isometry3d T_floor_base = floor.T_map_world * T_world_base;
  const Eigen::Vector3d forward = T_floor_base.linear().col(0);
  Eigen::Isometry3d T_floor_map = Eigen::Isometry3d::Identity();
  T_floor_map.linear() = Eigen::AngleAxisd(std::atan2(forward.y(), forward.x()), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_floor_map.translation() = Eigen::Vector3d(T_floor_base.translation().x(), T_floor_base.translation().y(), 0.0);
  return T_floor_map.inverse() * floor.T_map_world;
}

}  // namespace oikos::mapping
