// SPDX-License-Identifier: Apache-2.0
#include <dlib/image_transforms.h>
#include <dlib/opencv.h>

#include "bench/knobs/fhog.h"

namespace oikos::bench {

namespace {

using recognition::HogCells;
constexpr int kNumbers = 31;

/// dlib leaves the outermost cells out as ours do, but rounds the number of cells where ours cuts off.
HogCells describeFrom(const cv::Mat& bytes, const cv::Point& start) {
  const int cell_px = recognition::kDetectorHog.cell_px;
  const cv::Size cells_px((bytes.cols - start.x) / cell_px * cell_px, (bytes.rows - start.y) / cell_px * cell_px);
  dlib::array2d<dlib::matrix<float, kNumbers, 1>> fhog;
  dlib::extract_fhog_features(dlib::cv_image<dlib::bgr_pixel>(bytes(cv::Rect(start, cells_px))), fhog, cell_px);
  HogCells cells{static_cast<int>(fhog.nc()), static_cast<int>(fhog.nr()), kNumbers, {}};
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      cells.values.insert(cells.values.end(), fhog[row][column].begin(), fhog[row][column].end());
    }
  }
  return cells;
}

}  // namespace

std::optional<recognition::CellDescriber> findFhog() {
  return [](const cv::Mat& patch, const std::vector<cv::Point>& starts) {
    cv::Mat bytes;
    patch.convertTo(bytes, CV_8U, 255.0);
    std::vector<HogCells> cells;
    for (const cv::Point& start : starts) {
      cells.push_back(describeFrom(bytes, start));
    }
    return cells;
  };
}

}  // namespace oikos::bench
