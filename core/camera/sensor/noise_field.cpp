// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/noise_field.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace oikos::camera {

namespace {

constexpr std::uint64_t kShiftCounter = ~std::uint64_t{0} - 1;  // beyond all lattice points

}  // namespace

NoiseField::NoiseField(const NoiseStream& stream, const Shape& shape, int threads) : shape_(shape) {
  OIKOS_CHECK(shape.width > 0 && shape.height > 0 && shape.spacing_px > 0);
  const int spacing = shape.spacing_px;
  const std::uint64_t shift = stream.bits(kShiftCounter);
  shift_u_ = static_cast<int>((shift & 0xffffU) % static_cast<unsigned>(spacing));
  shift_v_ = static_cast<int>((shift >> 16U & 0xffffU) % static_cast<unsigned>(spacing));
  for (int i = 0; i < spacing; ++i) {
    const float right = static_cast<float>(i) / static_cast<float>(spacing);
    const float deviation = std::hypot(1.0F - right, right);
    weight_left_.push_back((1.0F - right) / deviation);
    weight_right_.push_back(right / deviation);
  }
  columns_ = (shape.width - 1 + shift_u_) / spacing + 2;
  const int rows = (shape.height - 1 + shift_v_) / spacing + 2;
  lattice_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
  const GaussianTable& table = gaussianTable();
  base::parallelFor(rows, threads, [&](int row) {
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    for (std::size_t i = first; i < first + static_cast<std::size_t>(columns_); ++i) {
      lattice_[i] = toGaussian(table, stream.bits(i));
    }
  });
}

void NoiseField::fillRow(int v, float* row) const {
  const int cell_v = (v + shift_v_) / shape_.spacing_px;
  const auto phase_v = static_cast<std::size_t>((v + shift_v_) % shape_.spacing_px);
  const float* upper = &lattice_[static_cast<std::size_t>(cell_v) * static_cast<std::size_t>(columns_)];
  const float* lower = upper + columns_;
  const float weight_upper = weight_left_[phase_v];
  const float weight_lower = weight_right_[phase_v];
  const auto mixed = [&](int column) { return weight_upper * upper[column] + weight_lower * lower[column]; };
  int column = 0;
  float left = mixed(0);
  float right = mixed(1);
  int phase = shift_u_;
  for (int u = 0; u < shape_.width; ++u) {
    row[u] = weight_left_[static_cast<std::size_t>(phase)] * left + weight_right_[static_cast<std::size_t>(phase)] * right;
    if (++phase == shape_.spacing_px) {
      phase = 0;
      ++column;
      left = right;
      right = column + 1 < columns_ ? mixed(column + 1) : 0.0F;
    }
  }
}

}  // namespace oikos::camera
