// SPDX-License-Identifier: Apache-2.0
#include "core/render/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/tone_curve.h"

namespace oikos::render {

namespace {

constexpr float kWhite = 65535.0F;

bool isGray(const cv::Mat& texture) {
  for (int v = 0; v < texture.rows; ++v) {
    const auto* const row = texture.ptr<cv::Vec3b>(v);
    if (!std::all_of(row, row + texture.cols, [](const cv::Vec3b& bgr) { return bgr[0] == bgr[1] && bgr[1] == bgr[2]; })) {
      return false;
    }
  }
  return true;
}

/// Light in 16 bits: one channel, or RGB and one of padding.
cv::Mat toLight(const cv::Mat& texture, int channels) {
  const geometry::ToneCurve& curve = geometry::ToneCurve::instance();
  cv::Mat light(texture.size(), CV_MAKETYPE(CV_16U, channels), cv::Scalar::all(0));
  for (int v = 0; v < texture.rows; ++v) {
    const auto* const from = texture.ptr<cv::Vec3b>(v);
    auto* const to = light.ptr<std::uint16_t>(v);
    for (int u = 0; u < texture.cols; ++u) {
      for (int c = 0; c < std::min(channels, 3); ++c) {
        to[channels * u + c] = static_cast<std::uint16_t>(std::lround(kWhite * curve.toLight(from[u][2 - c])));
      }
    }
  }
  return light;
}

/// floor(log2(x)) of a number of at least 1.
int exponentOf(float x) {
  return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23U) - 127;
}

/// The texel at or before a place that is at most one texel out of range, and how far beyond it the place lies.
struct Lattice {
  Lattice(float coordinate, int size) {
    const float within = coordinate - std::floor(coordinate);
    const float place = within * static_cast<float>(size) + (static_cast<float>(size) - 0.5F);  // one period on: no texel is below 0
    const auto whole = static_cast<int>(place);
    share = place - static_cast<float>(whole);
    index = whole >= size ? whole - size : whole;
    index = index >= size ? 0 : index;  // rounded up
  }
  int index;
  float share;
};

Eigen::Array4f texelAt(const std::uint16_t* texel) {
  return Eigen::Map<const Eigen::Array<std::uint16_t, 4, 1>>(texel).cast<int>().cast<float>();
}

}  // namespace

TexturePyramid::TexturePyramid(const cv::Mat& texture) : channels_(isGray(texture) ? 1 : 4) {
  cv::Mat light = toLight(texture, channels_);
  addLevel(light);
  while (light.cols > 1 || light.rows > 1) {
    cv::Mat next;
    cv::resize(light, next, {std::max(1, light.cols / 2), std::max(1, light.rows / 2)}, 0.0, 0.0, cv::INTER_AREA);
    light = next;
    addLevel(light);
  }
}

void TexturePyramid::addLevel(const cv::Mat& light) {
  cv::Mat padded;
  cv::copyMakeBorder(light, padded, 0, 1, 0, 1, cv::BORDER_WRAP);
  const auto* const first = padded.ptr<std::uint16_t>();
  levels_.push_back({light.cols, light.rows, {first, first + padded.total() * static_cast<std::size_t>(channels_)}});
}

Eigen::Array3f TexturePyramid::at(const Eigen::Vector2f& coordinate, float footprint_px) const {
  constexpr float kSqrt2 = 1.41421356F;
  const int wanted = footprint_px > 1.0F ? exponentOf(footprint_px * kSqrt2) : 0;  // the logarithm, rounded
  const Level& level = levels_[static_cast<std::size_t>(std::min(wanted, static_cast<int>(levels_.size()) - 1))];
  const Lattice column(coordinate.x(), level.width);
  const Lattice row(1.0F - coordinate.y(), level.height);
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(level.width + 1) * channels_;
  const std::uint16_t* const upper = level.texels.data() + row.index * stride + static_cast<std::ptrdiff_t>(column.index) * channels_;
  const std::uint16_t* const lower = upper + stride;
  if (channels_ == 1) {
    const auto mix = [&](const std::uint16_t* texel) {
      const auto left = static_cast<float>(texel[0]);
      return left + column.share * (static_cast<float>(texel[1]) - left);
    };
    const float above = mix(upper);
    return Eigen::Array3f::Constant((above + row.share * (mix(lower) - above)) * (1.0F / kWhite));
  }
  const auto mix = [&](const std::uint16_t* texel) -> Eigen::Array4f {
    const Eigen::Array4f left = texelAt(texel);
    return left + column.share * (texelAt(texel + 4) - left);
  };
  const Eigen::Array4f above = mix(upper);
  return ((above + row.share * (mix(lower) - above)) * (1.0F / kWhite)).head<3>();
}

}  // namespace oikos::render
