// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace oikos::metrics {

struct RoomShapeConfig {
  double search_m = 0.06;     ///< a wall is looked for so far on either side of where it truly is: less than walls are thick
  double inlier_m = 0.025;    ///< points of a wall lie so near to where most of the points are
  double from_end_m = 0.1;    ///< of a wall; nearer to a corner points may be the next wall's
  double lowest_m = 0.15;     ///< above the floor: skirting is below
  double highest_m = 2.3;     ///< above the floor
  int min_points = 200;       ///< fewer: the wall was not seen
  double min_length_m = 0.4;  ///< along the wall, that the points spread over
  double to_corner_m = 0.7;   ///< at most so far from what was seen of both its walls a corner is measured

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("search_m", search_m);
    visitor("inlier_m", inlier_m);
    visitor("from_end_m", from_end_m);
    visitor("lowest_m", lowest_m);
    visitor("highest_m", highest_m);
    visitor("min_points", min_points);
    visitor("min_length_m", min_length_m);
    visitor("to_corner_m", to_corner_m);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// A wall's line on the floor plan: normal · p = offset_m, the normal of length 1; `from_m` to `to_m` along the outline's edge were seen.
struct WallLine {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double offset_m = 0.0;
  double from_m = 0.0;
  double to_m = 0.0;
};

/// One length of a room, truly and in the map.
struct RoomLength {
  std::size_t from = 0;  ///< number of a wall or a corner; wall i runs from corner i to corner i + 1
  std::size_t to = 0;
  double true_m = 0.0;
  double measured_m = 0.0;

  [[nodiscard]] double error_m() const { return measured_m - true_m; }
};

struct RoomShape {
  std::vector<std::optional<WallLine>> walls;  ///< one an edge of the outline; nothing: not seen
  std::vector<RoomLength> between_walls;       ///< opposite ones: parallel to 5 degrees, side by side, facing each other
  std::vector<RoomLength> between_corners;     ///< all pairs of corners near which both walls were seen
};

/// How long a room is in a map: each wall is a vertical plane fitted to the points about it, corners are where the planes of neighbouring
/// walls meet; compared to the true outline. Paper 003 (6.2.1.3) judges its maps by these. `points_map` are in the frame of the outline
/// to `search_m`, z up, the floor at 0. O(points × walls).
[[nodiscard]] RoomShape measureRoom(const std::vector<Eigen::Vector2d>& outline_map, const std::vector<Eigen::Vector3f>& points_map,
                                    const RoomShapeConfig& config = {});

}  // namespace oikos::metrics
