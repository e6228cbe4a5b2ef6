// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/hog.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "core/base/error.h"

namespace oikos::recognition {

namespace {

constexpr float kTruncation = 0.2F;
constexpr float kDark = 0.3F;  // what noise adds up to in a block: keeps those without structure small

/// The two neighbours of a position between bins, and the share of the second.
struct Between {
  int first;
  float share;
};

Between between(float position) {
  const float floor = std::floor(position);
  return {static_cast<int>(floor), position - floor};
}

void addTo(HogCells& cells, int column, int row, const Between& bin, float weight) {
  if (column < 0 || row < 0 || column >= cells.columns || row >= cells.rows) {
    return;
  }
  float* histogram = cells.at(column, row);
  histogram[bin.first] += weight * (1.0F - bin.share);
  histogram[bin.first + 1 == cells.orientations ? 0 : bin.first + 1] += weight * bin.share;
}

float energyOf(const HogCells& cells, int column, int row) {
  const float* histogram = cells.at(column, row);
  float sum = 0.0F;
  for (int i = 0; i < cells.orientations; ++i) {
    sum += histogram[i] * histogram[i];
  }
  return sum;
}

}  // namespace

Gradients differentiate(const cv::Mat& image) {
  OIKOS_CHECK(image.depth() == CV_32F);
  Gradients gradients{cv::Mat::zeros(image.size(), CV_32FC1), cv::Mat::zeros(image.size(), CV_32FC1)};
  const int channels = image.channels();
  for (int v = 1; v + 1 < image.rows; ++v) {
    const float* above = image.ptr<float>(v - 1);
    const float* row = image.ptr<float>(v);
    const float* below = image.ptr<float>(v + 1);
    for (int u = 1; u + 1 < image.cols; ++u) {
      float across = 0.0F;
      float along = 0.0F;
      float greatest = 0.0F;
      for (int channel = 0; channel < channels; ++channel) {
        const float x = row[(u + 1) * channels + channel] - row[(u - 1) * channels + channel];
        const float y = below[u * channels + channel] - above[u * channels + channel];
        if (x * x + y * y > greatest) {
          greatest = x * x + y * y;
          across = x;
          along = y;
        }
      }
      const float turn = cv::fastAtan2(along, across) / 180.0F;
      gradients.magnitude.ptr<float>(v)[u] = std::sqrt(greatest);
      gradients.orientation.ptr<float>(v)[u] = std::min(turn - std::floor(turn), 0.999999F);
    }
  }
  return gradients;
}

HogCells histogramCells(const Gradients& gradients, const HogShape& shape, const cv::Point& start) {
  const cv::Size size = gradients.magnitude.size() - cv::Size(start);
  HogCells cells{size.width / shape.cell_px, size.height / shape.cell_px, shape.orientations, {}};
  cells.values.assign(static_cast<std::size_t>(cells.columns * cells.rows * cells.orientations), 0.0F);
  const float per_cell = 1.0F / static_cast<float>(shape.cell_px);
  const auto bins = static_cast<float>(shape.orientations);
  for (int v = 0; v < size.height; ++v) {
    const Between down = between((static_cast<float>(v) + 0.5F) * per_cell - 0.5F);
    const float* magnitudes = gradients.magnitude.ptr<float>(v + start.y) + start.x;
    const float* orientations = gradients.orientation.ptr<float>(v + start.y) + start.x;
    for (int u = 0; u < size.width; ++u) {
      const float magnitude = magnitudes[u];
      const Between bin = between(orientations[u] * bins);
      const Between right = between((static_cast<float>(u) + 0.5F) * per_cell - 0.5F);
      addTo(cells, right.first, down.first, bin, magnitude * (1.0F - right.share) * (1.0F - down.share));
      addTo(cells, right.first + 1, down.first, bin, magnitude * right.share * (1.0F - down.share));
      addTo(cells, right.first, down.first + 1, bin, magnitude * (1.0F - right.share) * down.share);
      addTo(cells, right.first + 1, down.first + 1, bin, magnitude * right.share * down.share);
    }
  }
  return cells;
}

HogCells normaliseByBlocks(const HogCells& cells) {
  HogCells normal{std::max(0, cells.columns - 2), std::max(0, cells.rows - 2), cells.orientations, {}};
  normal.values.assign(static_cast<std::size_t>(normal.columns * normal.rows * normal.orientations), 0.0F);
  std::vector<float> energy(static_cast<std::size_t>(cells.columns * cells.rows));
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      energy[static_cast<std::size_t>(row * cells.columns + column)] = energyOf(cells, column, row);
    }
  }
  // Of the block whose upper left cell it is.
  const auto perLength = [&](int column, int row) {
    const auto at = static_cast<std::size_t>(row * cells.columns + column);
    const auto below = at + static_cast<std::size_t>(cells.columns);
    return 1.0F / std::sqrt(energy[at] + energy[at + 1] + energy[below] + energy[below + 1] + kDark * kDark);
  };
  for (int row = 0; row < normal.rows; ++row) {
    for (int column = 0; column < normal.columns; ++column) {
      const float* histogram = cells.at(column + 1, row + 1);
      float* out = normal.at(column, row);
      for (int block = 0; block < 4; ++block) {
        const float scale = perLength(column + block % 2, row + block / 2);
        for (int i = 0; i < cells.orientations; ++i) {
          out[i] += 0.25F * std::min(kTruncation, histogram[i] * scale);
        }
      }
    }
  }
  return normal;
}

HogCells normaliseAsWhole(HogCells cells) {
  float sum = kDark * kDark;
  for (const float value : cells.values) {
    sum += value * value;
  }
  for (float& value : cells.values) {
    value /= std::sqrt(sum);
  }
  return cells;
}

}  // namespace oikos::recognition
