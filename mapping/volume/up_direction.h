// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace oikos::mapping {

/// A voxel's worth of surface.
struct SurfaceElement {
  Eigen::Vector3d point_world;
  Eigen::Vector3d normal_world;  ///< unit length, towards the cameras
};

/// What is known of up beforehand.
struct UpPrior {
  Eigen::Vector3d image_up_world;  ///< unit length
  double max_tilt_rad;             ///< how far up may be from it
};

struct UpDirection {
  Eigen::Vector3d up_world;
  double agreement = 0.0;  ///< share of the elements that face along or across it, within 10°; 0: nothing to go by
};

/// The direction near image-up along or across which most of the surface faces: floors, tables, ceilings along it, walls and
/// fronts across.
[[nodiscard]] UpDirection findUp(const std::vector<SurfaceElement>& surface, const UpPrior& prior);

}  // namespace oikos::mapping
