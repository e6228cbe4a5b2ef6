// SPDX-License-Identifier: Apache-2.0
// What one image says for and against a handle at each place around where it is believed, to be summed over images: a bar that no single
// image shows above its noise may stand out of many.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace oikos::registration {

/// Of one place: with A the height that stands out there, the log likelihood over a bare front is A * standing_out - A^2 * seen / 2.
struct PlaceEvidence {
  double along_m = 0.0;   ///< z of the believed handle
  double across_m = 0.0;  ///< and y
  double standing_out = 0.0;
  double seen = 0.0;
};

struct GripEvidence {
  Eigen::Isometry3d T_part_believed = Eigen::Isometry3d::Identity();  ///< the believed handle on the front as this image has it
  std::vector<PlaceEvidence> places;  ///< the same ones for each image of a handle; none: it was not looked at
};

/// Where a handle stands out of all images together.
struct EvidencePeak {
  double gain = 0.0;                                     ///< log likelihood over a bare front
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();     ///< (across, along): the posterior's mean
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< the posterior's
};

/// `share`: of each image's information that counts; `place_sigma_m`: of the belief, in each direction. Nothing if there is no evidence.
[[nodiscard]] std::optional<EvidencePeak> sumEvidence(const std::vector<const GripEvidence*>& images, double share, double place_sigma_m,
                                                      double max_height_m);

}  // namespace oikos::registration
