// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/camera/pinhole_camera.h"

namespace oikos::mapping {

/// A small planar patch of a keyframe's image with its depth: what is followed from frame to frame and what the final
/// refinement adjusts. Its place is one number, the inverse depth along the ray of its pixel in its host keyframe
/// (Civera et al., T-RO 2008; Engel et al., "Direct Sparse Odometry", PAMI 2018).
struct Landmark {
  int host = -1;                                                     ///< node id of the keyframe it was found in
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();                   ///< in the host, level 0
  double inverse_depth = 0.0;                                        ///< 1/m, from the host's depth image, later refined
  double measured_inverse_depth = 0.0;                               ///< 1/m, from the host's depth image
  double sigma = 0.0;                                                ///< of measured_inverse_depth, 1/m
  Eigen::Vector2d inverse_depth_gradient = Eigen::Vector2d::Zero();  ///< of the surface about it, 1/m per pixel
};

/// Where a landmark was seen. All frames keep theirs until the poses are solved: 16 bytes each.
struct Observation {
  int landmark = -1;
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();                      ///< level 0
  Eigen::half depth_m = std::numeric_limits<Eigen::half>::quiet_NaN();  ///< the depth image's reading there (0.05 %); NaN = none
  std::int8_t level = 0;  ///< pyramid level of the finest alignment: the error grows by 2^level
};
static_assert(sizeof(Observation) == 16);

[[nodiscard]] inline Eigen::Vector3d pointInHost(const Landmark& landmark, const camera::PinholeCamera& camera) {
  return camera.ray(landmark.pixel.x(), landmark.pixel.y()) / landmark.inverse_depth;
}

}  // namespace oikos::mapping
