// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "mapping/change/change_finder.h"
#include "registration/pose_search.h"
#include "semantic/model/home.h"

namespace oikos::tracking {

struct MovedFurnitureConfig {
  registration::ScanConfig scan{.step_px = 2, .normal_radius_px = 3};  ///< of images of 320×240
  /// Asks for less overlap than where one view stands alone, as views have to agree.
  registration::SearchConfig search{.align = {}, .min_overlap = 0.68};
  int views = 6;                 ///< of a piece, from directions apart
  double view_apart_deg = 5.0;   ///< so far
  double best_distance_m = 2.0;  ///< views from about here come first
  double max_distance_m = 4.0;   ///< from the piece's middle
  double min_fit = 0.5;          ///< share of the model that a view must explain, if another one agrees;
  double lone_fit = 0.8;         ///< one that stands alone
  double agree_m = 0.03;         ///< views that find the piece within so much of each other agree
  double agree_deg = 2.0;
  double min_moved_m = 0.04;  ///< nearer to where it was believed, and turned less, it has not moved: the belief is a tape's
  double min_moved_deg = 3.0;
  int threads = 1;  ///< the result does not depend on it

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("scan", scan);
    visitor("views", views);
    visitor("view_apart_deg", view_apart_deg);
    visitor("best_distance_m", best_distance_m);
    visitor("max_distance_m", max_distance_m);
    visitor("min_fit", min_fit);
    visitor("lone_fit", lone_fit);
    visitor("agree_m", agree_m);
    visitor("agree_deg", agree_deg);
    visitor("min_moved_m", min_moved_m);
    visitor("min_moved_deg", min_moved_deg);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// A piece that no longer stands where the home has it.
struct MovedPiece {
  semantic::ObjectId id;
  Eigen::Isometry3d T_map_before = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_after = Eigen::Isometry3d::Identity();
  int views = 0;          ///< that agree
  double spread_m = 0.0;  ///< of their answers about the mean, root mean square
  double fit = 0.0;       ///< the worst of theirs
};

/// Where the home's shiftable furniture stands now (S221): each piece that a scan has in view is registered to the scans from where it is
/// believed to be, and from what is new where it could have gone to; views from several directions must agree. Fixed furniture does not
/// move, and of movable pieces the changes' boxes are all that is said (S222). In the home's order. `home_folder` is where model files are.
/// Throws Error for a model that cannot be made.
[[nodiscard]] std::vector<MovedPiece> findMovedFurniture(const semantic::Home& home, const std::filesystem::path& home_folder,
                                                         const std::vector<mapping::LocatedScan>& scans,
                                                         const std::vector<mapping::Change>& changes, const MovedFurnitureConfig& config);

}  // namespace oikos::tracking
