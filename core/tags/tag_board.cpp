// SPDX-License-Identifier: Apache-2.0
#include "core/tags/tag_board.h"

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/tags/tag_family.h"

namespace oikos::tags {

namespace {

int cellsAcross(int tags, int gap_cells) {
  return tags * kTagCells + (tags + 1) * gap_cells;
}

/// First cell of a tag along a side, from the left or from the top.
int firstCell(int tag, int gap_cells) {
  return gap_cells + tag * (kTagCells + gap_cells);
}

}  // namespace

std::vector<std::string> TagBoard::validate() const {
  constexpr int kMostTags = 24;  // a side
  base::ConfigRules rules;
  rules.between("columns", columns, 1, kMostTags).between("rows", rows, 1, kMostTags);
  rules.between("tag_size_m", tag_size_m, 0.01, 2.0).between("gap_cells", gap_cells, 1, 8);
  const int last_start = tagFamilySize() - (rules.messages().empty() ? tagCount() : 1);
  rules.require(last_start >= 0, "columns", columns, "times rows must be at most " + std::to_string(tagFamilySize()) + " tags");
  if (last_start >= 0) {
    rules.between("first_id", first_id, 0, last_start);
  }
  return rules.messages();
}

double TagBoard::width_m() const {
  return tag_size_m / kTagCells * cellsAcross(columns, gap_cells);
}

double TagBoard::height_m() const {
  return tag_size_m / kTagCells * cellsAcross(rows, gap_cells);
}

std::optional<std::array<Eigen::Vector3d, 4>> TagBoard::findCorners(int id) const {
  const int index = id - first_id;
  if (index < 0 || index >= tagCount()) {
    return std::nullopt;
  }
  const double cell_m = tag_size_m / kTagCells;
  const double left_m = -0.5 * width_m() + cell_m * firstCell(index % columns, gap_cells);
  const double top_m = 0.5 * height_m() - cell_m * firstCell(index / columns, gap_cells);
  const double right_m = left_m + tag_size_m;
  const double bottom_m = top_m - tag_size_m;
  return std::array<Eigen::Vector3d, 4>{Eigen::Vector3d(left_m, bottom_m, 0.0), Eigen::Vector3d(right_m, bottom_m, 0.0),
                                        Eigen::Vector3d(right_m, top_m, 0.0), Eigen::Vector3d(left_m, top_m, 0.0)};
}

cv::Mat drawTagBoard(const TagBoard& board, int px_per_cell) {
  OIKOS_CHECK(board.validate().empty() && px_per_cell > 0);
  const auto side = [&](int tags) { return cellsAcross(tags, board.gap_cells) * px_per_cell; };
  cv::Mat picture(side(board.rows), side(board.columns), CV_8UC3, cv::Scalar::all(255));
  const auto fill = [&](const cv::Point& cell, int cells, int brightness) {
    picture(cv::Rect(cell * px_per_cell, cv::Size(cells, cells) * px_per_cell)).setTo(cv::Scalar::all(brightness));
  };
  for (int tag = 0; tag < board.tagCount(); ++tag) {
    const cv::Point start(firstCell(tag % board.columns, board.gap_cells), firstCell(tag / board.columns, board.gap_cells));
    fill(start, kTagCells, 0);
    for (const cv::Point& cell : whiteCells(board.first_id + tag)) {
      fill(start + cell, 1, 255);
    }
  }
  return picture;
}

}  // namespace oikos::tags
