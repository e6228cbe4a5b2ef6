// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mapping/change/change_config.h"

namespace oikos::mapping {

/// How a drive that extends a map is held against it.
struct RevisionConfig {
  double view_step_m = 0.25;     ///< a frame is compared where the camera has moved so far since the last one
  double view_step_deg = 12.0;   ///< or turned
  double pose_sigma_m = 0.01;    ///< of a frame's place in the map, once both are optimised together
  double pose_sigma_deg = 0.25;  ///< and of its rotation
  double known_share = 0.9;      ///< of a new keyframe's readings: if earlier ones show so much of it, it is not kept
  double like_view_deg = 30.0;   ///< between the optical axes; what is seen from elsewhere looks different
  int witnesses = 3;             ///< keyframes that are to show each changed voxel: three readings occupy the freest voxel
  int min_gain_voxels = 8;       ///< changed voxels that one more keyframe must show to be worth keeping
  FreeSpaceConfig free;
  ChangeConfig change;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("view_step_m", view_step_m);
    visitor("view_step_deg", view_step_deg);
    visitor("pose_sigma_m", pose_sigma_m);
    visitor("pose_sigma_deg", pose_sigma_deg);
    visitor("known_share", known_share);
    visitor("like_view_deg", like_view_deg);
    visitor("witnesses", witnesses);
    visitor("min_gain_voxels", min_gain_voxels);
    visitor("free", free);
    visitor("change", change);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace oikos::mapping
