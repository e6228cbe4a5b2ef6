// SPDX-License-Identifier: Apache-2.0
// Histograms of oriented gradients (Dalal & Triggs, "Histograms of oriented gradients for human detection", CVPR 2005,
// doi:10.1109/CVPR.2005.177), with the normalisation of Felzenszwalb, Girshick, McAllester & Ramanan, "Object detection with
// discriminatively trained part-based models", PAMI 2010, doi:10.1109/TPAMI.2009.167: as the user's paper 003 has them (5.2.1.3, 5.2.1.4).
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace oikos::recognition {

struct HogShape {
  int cell_px = 6;
  int orientations = 9;  ///< over 180 degrees: which side is brighter does not matter
};

/// Histograms of the cells of an image, row by row, `orientations` numbers each. Gradients are shared out between the nearest two
/// orientations and four cells.
struct HogCells {
  int columns = 0;
  int rows = 0;
  int orientations = 0;
  std::vector<float> values;

  [[nodiscard]] const float* at(int column, int row) const {
    return &values[static_cast<std::size_t>((row * columns + column) * orientations)];
  }
  [[nodiscard]] float* at(int column, int row) { return &values[static_cast<std::size_t>((row * columns + column) * orientations)]; }
};

/// Of each pixel how steep the image is there and in which direction; of several channels the one that is steepest.
struct Gradients {
  cv::Mat magnitude;    ///< CV_32FC1; 0 on the border
  cv::Mat orientation;  ///< CV_32FC1, [0, 1): 1 is 180 degrees
};
/// `image`: CV_32FC1 or CV_32FC3.
[[nodiscard]] Gradients differentiate(const cv::Mat& image);

/// Cells begin at `start`; what is left over at the right and below is not used.
[[nodiscard]] HogCells histogramCells(const Gradients& gradients, const HogShape& shape, const cv::Point& start = {});

/// Each cell divided by the length of each of the four blocks of 2x2 cells that it is in, truncated at 0.2, and the mean of the four. The
/// outermost cells have no four blocks and are left out: two columns and rows less.
[[nodiscard]] HogCells normaliseByBlocks(const HogCells& cells);

/// All cells divided by their common length.
[[nodiscard]] HogCells normaliseAsWhole(HogCells cells);

}  // namespace oikos::recognition
