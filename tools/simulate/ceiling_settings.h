// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/tags/tag_board.h"

namespace oikos::simulate {

/// A camera that hangs still and watches a board of tags on the robot, as the papers took the robot's true path. By default it has the
/// lens of a Kinect 1 at its colour camera's full size.
struct CeilingSettings {
  std::vector<double> position_m;                   ///< x, y, z in `map`; empty: there is no such camera
  std::vector<double> look_at_m = {0.0, 0.0, 0.0};  ///< in `map`
  int width = 1280;
  int height = 1024;
  double fx = 1050.0;
  double fy = 1050.0;
  double cx = 639.5;
  double cy = 511.5;
  std::vector<double> distortion = {0.0, 0.0, 0.0, 0.0, 0.0};  ///< k1, k2, p1, p2, k3
  int jpeg_quality = 95;                                       ///< 0: PNG
  std::vector<double> board_m = {-0.15, 0.0, 0.5};             ///< the board's middle in `base`; it lies flat, its upper edge ahead
  tags::TagBoard board;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("position_m", position_m);
    visitor("look_at_m", look_at_m);
    visitor("width", width);
    visitor("height", height);
    visitor("fx", fx);
    visitor("fy", fy);
    visitor("cx", cx);
    visitor("cy", cy);
    visitor("distortion", distortion);
    visitor("jpeg_quality", jpeg_quality);
    visitor("board_m", board_m);
    visitor("board", board);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace oikos::simulate
