// SPDX-License-Identifier: Apache-2.0
// From what a recogniser sees in the camera's frame to a place in the home.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "semantic/model/home.h"

namespace oikos::semantic {

/// What a recogniser hands on to memory and grasping: S281 (the user's paper 003, table 8) and S320 (paper 000, V-B.2).
struct Detection {
  bool is_found = false;
  std::string name;  ///< the object's id
  Eigen::Isometry3d T_camera_object = Eigen::Isometry3d::Identity();
  std::optional<Box> box_object;  ///< its frame is at the box's centre
  GraspGeometry grasp;
};

/// A detection that knows no more than how far away the object is, at the middle of the image: T_map_camera * (0, 0, depth, 1) (S321).
[[nodiscard]] Eigen::Vector3d markerInMap(const Eigen::Isometry3d& T_map_camera, double depth_m);

/// What an object at this pose is in, on or under, by the boxes of all furniture where their joints hold them: in a box rather than on one
/// rather than under one; of several in the smallest, on the one whose top is nearest to its foot, under the lowest. Else the floor of the
/// room whose outline it is in; nothing: it is in no room.
[[nodiscard]] std::optional<Placement> findPlacement(const Home& home, const Eigen::Isometry3d& T_map_object,
                                                     const std::optional<Box>& box_object);

}  // namespace oikos::semantic
