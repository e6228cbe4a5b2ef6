// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

namespace oikos::tags {

constexpr int kTagCells = 8;  ///< across the black square of a tag of the family 36h11

/// How many tags the family has.
[[nodiscard]] int tagFamilySize();

/// The cells of a tag that are white, counted from the upper left corner of its black square. `id` is one of the family's.
[[nodiscard]] std::vector<cv::Point> whiteCells(int id);

}  // namespace oikos::tags
