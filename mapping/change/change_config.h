// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mapping/volume/depth_filter.h"

namespace oikos::mapping {

/// When a voxel of the map counts as free or as occupied (Schmid et al., "Dynablox", RA-L 2023, doi:10.1109/LRA.2023.3305239: only space
/// that was seen free repeatedly, with its neighbours, is trusted to be free).
struct FreeSpaceConfig {
  int min_views = 3;                      ///< images whose rays passed through the voxel
  double min_view_angle_rad = 0.262;      ///< between the first of these views and another one; 15°
  double max_free_probability = 0.3;      ///< of being occupied
  double min_occupied_probability = 0.8;  ///< two readings and no ray through it

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("min_views", min_views);
    visitor("min_view_angle_rad", min_view_angle_rad);
    visitor("max_free_probability", max_free_probability);
    visitor("min_occupied_probability", min_occupied_probability);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct ChangeConfig {
  double sigmas = 2.5;             ///< how many standard deviations of pose, depth and map a change must stand clear by
  double map_sigma_m = 0.01;       ///< of the map's surfaces
  double depth_sigma_1m = 0.002;   ///< of a reading at 1 m; grows with the square of the depth (Khoshelham & Elberink, Sensors 2012)
  double max_tolerance_m = 0.25;   ///< where the map cannot be told apart by less, nothing is compared
  DepthFilterConfig surface;       ///< which readings show a surface; all readings can hide one
  int pixel_stride = 2;            ///< every n-th pixel of every n-th row
  int min_points = 2;              ///< readings in a voxel that make a surface
  double max_missing_share = 0.2;  ///< of the pixels of each square of a voxel's size about one that is seen through
  double min_agreement = 0.7;      ///< of the views that see a voxel: share that sees the change
  double join_m = 0.11;            ///< changed voxels this near to each other are one change
  int min_seed_voxels = 6;         ///< that stand clear in full
  double min_size_m = 0.1;         ///< of the second longest side: less is a sliver along an edge
  double min_known_share = 0.3;    ///< of a scan's surface: less lies in the map's space, and the scan is not compared
  double max_changed_share = 0.6;  ///< of a scan's surface, or of the map's in view: more has changed, and the scan is misplaced
  int threads = 1;                 ///< the result does not depend on it; not written to files

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("sigmas", sigmas);
    visitor("map_sigma_m", map_sigma_m);
    visitor("depth_sigma_1m", depth_sigma_1m);
    visitor("max_tolerance_m", max_tolerance_m);
    visitor("surface", surface);
    visitor("pixel_stride", pixel_stride);
    visitor("min_points", min_points);
    visitor("max_missing_share", max_missing_share);
    visitor("min_agreement", min_agreement);
    visitor("join_m", join_m);
    visitor("min_seed_voxels", min_seed_voxels);
    visitor("min_size_m", min_size_m);
    visitor("min_known_share", min_known_share);
    visitor("max_changed_share", max_changed_share);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace oikos::mapping
