// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace oikos::tags {

/// A flat white board with a grid of AprilTags of the family 36h11 (Olson, "AprilTag: A robust and flexible visual fiducial system", ICRA
/// 2011, doi:10.1109/ICRA.2011.5979561). Frame `board`: origin in the middle, x to the right, y up, z out of the picture.
struct TagBoard {
  int columns = 3;
  int rows = 2;
  int first_id = 0;          ///< of the upper left tag; the others follow row by row
  double tag_size_m = 0.16;  ///< edge of the black square, which is 8 cells wide
  int gap_cells = 2;         ///< white between the tags and around them

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("columns", columns);
    visitor("rows", rows);
    visitor("first_id", first_id);
    visitor("tag_size_m", tag_size_m);
    visitor("gap_cells", gap_cells);
  }
  [[nodiscard]] std::vector<std::string> validate() const;

  [[nodiscard]] int tagCount() const { return columns * rows; }
  [[nodiscard]] double width_m() const;
  [[nodiscard]] double height_m() const;
  /// Corners of a tag's black square: lower left, lower right, upper right, upper left. Nothing: it is not on the board.
  [[nodiscard]] std::optional<std::array<Eigen::Vector3d, 4>> findCorners(int id) const;
};

/// The board's picture, CV_8UC3, black and white, `px_per_cell` pixels a cell.
[[nodiscard]] cv::Mat drawTagBoard(const TagBoard& board, int px_per_cell);

}  // namespace oikos::tags
