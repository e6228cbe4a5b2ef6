// SPDX-License-Identifier: Apache-2.0
#include "core/render/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace oikos::render {

namespace {

constexpr int kEncodingSteps = 4096;

const std::array<float, 256>& decoding() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = linearOf(static_cast<float>(i) / 255.0F);
    }
    return values;
  }();
  return table;
}

/// By the square root of the light, so that the dark end has steps enough.
const std::array<std::uint8_t, kEncodingSteps + 1>& encoding() {
  static const std::array<std::uint8_t, kEncodingSteps + 1> table = [] {
    std::array<std::uint8_t, kEncodingSteps + 1> values{};
    for (int i = 0; i <= kEncodingSteps; ++i) {
      const double root = static_cast<double>(i) / kEncodingSteps;
      const double linear = root * root;
      const double srgb = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
      values[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255.0 * srgb));
    }
    return values;
  }();
  return table;
}

Eigen::Vector3f linearRgb(const cv::Vec3b& bgr) {
  const auto& table = decoding();
  return {table[bgr[2]], table[bgr[1]], table[bgr[0]]};
}

/// Of an index that is at most one step out of range.
int wrapped(int index, int size) {
  return index < 0 ? index + size : index >= size ? index - size : index;
}

}  // namespace

float linearOf(std::uint8_t srgb) {
  return decoding()[srgb];
}

float linearOf(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

std::uint8_t srgbOf(float linear) {
  const float root = std::sqrt(std::clamp(linear, 0.0F, 1.0F));
  return encoding()[static_cast<std::size_t>(root * kEncodingSteps + 0.5F)];
}

TexturePyramid::TexturePyramid(const cv::Mat& texture) : levels_{texture} {
  while (levels_.back().cols > 1 || levels_.back().rows > 1) {
    const cv::Size half(std::max(1, levels_.back().cols / 2), std::max(1, levels_.back().rows / 2));
    cv::Mat next;
    cv::resize(levels_.back(), next, half, 0.0, 0.0, cv::INTER_AREA);
    levels_.push_back(next);
  }
}

Eigen::Vector3f TexturePyramid::at(const Eigen::Vector2f& coordinate, float footprint_px) const {
  const int level = footprint_px > 1.0F ? std::ilogb(footprint_px * std::numbers::sqrt2_v<float>) : 0;  // the logarithm, rounded
  const cv::Mat& image = levels_[static_cast<std::size_t>(std::min(level, static_cast<int>(levels_.size()) - 1))];
  const float x = (coordinate.x() - std::floor(coordinate.x())) * static_cast<float>(image.cols) - 0.5F;
  const float y = (1.0F - (coordinate.y() - std::floor(coordinate.y()))) * static_cast<float>(image.rows) - 0.5F;
  const auto left = static_cast<int>(std::floor(x));
  const auto top = static_cast<int>(std::floor(y));
  const float right_share = x - static_cast<float>(left);
  const float lower_share = y - static_cast<float>(top);
  const auto* const upper = image.ptr<cv::Vec3b>(wrapped(top, image.rows));
  const auto* const lower = image.ptr<cv::Vec3b>(wrapped(top + 1, image.rows));
  const int left_column = wrapped(left, image.cols);
  const int right_column = wrapped(left + 1, image.cols);
  const Eigen::Vector3f above = (1.0F - right_share) * linearRgb(upper[left_column]) + right_share * linearRgb(upper[right_column]);
  const Eigen::Vector3f below = (1.0F - right_share) * linearRgb(lower[left_column]) + right_share * linearRgb(lower[right_column]);
  return (1.0F - lower_share) * above + lower_share * below;
}

}  // namespace oikos::render
