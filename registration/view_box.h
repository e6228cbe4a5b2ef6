// SPDX-License-Identifier: Apache-2.0
// Where in a picture models can be seen at all. Included by this folder's sources and its tests only.
#pragma once

#include <Eigen/Geometry>

#include "core/camera/pinhole_camera.h"
#include "core/render/scene.h"
#include "registration/scan.h"

namespace oikos::registration {

/// The pixels that parts of the scene can cover (hidden ones too), and what is `margin_m` beside them; all of the picture if one of them
/// reaches behind the camera. Empty (right <= left) if none is in view.
[[nodiscard]] PixelBox boxInView(const render::Scene& scene, const Eigen::Isometry3d& T_map_camera, const camera::PinholeCamera& camera,
                                 double margin_m);

}  // namespace oikos::registration
