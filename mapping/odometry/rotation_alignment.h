// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/camera/pinhole_camera.h"
#include "mapping/odometry/image_pyramid.h"

namespace oikos::mapping {

struct [[nodiscard]] RotationAlignment {
  bool converged = false;  ///< the search has settled; whether on the same place, `rms` and what follows must tell
  Eigen::Matrix3d R_previous_current = Eigen::Matrix3d::Identity();
  double rms = 0.0;  ///< grey values, over the overlap
};

/// The rotation between two images of one camera that explains most of their difference, found photometrically on small
/// images (about 80 x 60) with gain and bias: a first guess under fast turning that needs neither depth nor features
/// (Whelan et al., "ElasticFusion", RSS 2015, section III-B; Lovegrove & Davison, ECCV 2010).
RotationAlignment alignRotation(const ImagePyramid& previous, const ImagePyramid& current, const camera::PinholeCamera& camera,
                                const Eigen::Matrix3d& R_previous_current_guess);

}  // namespace oikos::mapping
