// SPDX-License-Identifier: Apache-2.0
// The faces of a part that handles stand on, as the model has them.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/model/articulated_model.h"

namespace oikos::registration {

/// One handle on its front.
struct FrontHandle {
  int handle = 0;  ///< index in the model
  /// Its origin lies on no particular side of the front: x is how far the grip is before the face.
  Eigen::Isometry3d T_front_handle = Eigen::Isometry3d::Identity();
};

/// A plane face. Frame `front`: x out of the face, the origin in the face below the first handle, z along that handle's grip.
struct FrontFace {
  int part = 0;
  Eigen::Isometry3d T_part_front = Eigen::Isometry3d::Identity();
  Eigen::AlignedBox2d outline_front;  ///< (y, z)
  std::vector<FrontHandle> handles;
};

/// The faces that the model's handles stand on: of all triangles of the part that face as the handle does and lie up to `max_reach_m`
/// behind its grip, those in the plane with the largest area. A handle before no such face belongs to none. Ordered by first handle.
[[nodiscard]] std::vector<FrontFace> frontFaces(const model::ArticulatedModel& model, double max_reach_m);

}  // namespace oikos::registration
