// SPDX-License-Identifier: Apache-2.0
#include "registration/scan_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

namespace oikos::registration {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

void clear(std::vector<float>& row, std::size_t size) {
  row.assign(size, 0.0F);
}

}  // namespace

RowNormals::RowNormals(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const ScanConfig& config)
    : depth_m_(depth_m),
      camera_(camera),
      step_px_(config.step_px),
      radius_px_(config.normal_radius_px),
      stride_px_(std::max(1, config.normal_radius_px / 2)),
      max_step_share_(static_cast<float>(config.max_step_share)),
      columns_(static_cast<std::size_t>((camera.width + config.step_px - 1) / config.step_px)),
      margin_(static_cast<std::size_t>((config.normal_radius_px + config.step_px - 1) / config.step_px)),
      phases_(static_cast<std::size_t>(config.step_px), Row(columns_ + 2 * margin_, kNone)),
      centre_(columns_),
      samples_of_row_(columns_, 0.0F),
      x_(columns_),
      y_(columns_),
      z_(columns_) {
  for (int du = -radius_px_; du <= radius_px_; du += stride_px_) {
    for (std::size_t i = 0; i < columns_; ++i) {
      const int u = static_cast<int>(i) * step_px_ + du;
      samples_of_row_[i] += u >= 0 && u < camera_.width ? 1.0F : 0.0F;
    }
  }
}

void RowNormals::fit(int v_px) {
  loadRow(v_px);
  std::copy_n(loaded(0), columns_, centre_.begin());
  for (Row* sum : {&count_, &u_, &v_, &uu_, &uv_, &vv_, &q_, &qu_, &qv_}) {
    clear(*sum, columns_);
  }
  rows_in_image_ = 0.0F;
  for (int dv = -radius_px_; dv <= radius_px_; dv += stride_px_) {
    if (v_px + dv >= 0 && v_px + dv < camera_.height) {
      loadRow(v_px + dv);
      addRow(dv);
      rows_in_image_ += 1.0F;
    }
  }
  solve(v_px);
}

void RowNormals::loadRow(int v_px) {
  const float* const depth_m = depth_m_.ptr<float>(v_px);
  for (int phase = 0; phase < step_px_; ++phase) {
    float* const to = phases_[static_cast<std::size_t>(phase)].data() + margin_;
    const int columns = (camera_.width - phase + step_px_ - 1) / step_px_;
    for (int i = 0; i < columns; ++i) {
      to[i] = 1.0F / depth_m[i * step_px_ + phase];
    }
  }
}

/// Inverse depth of the pixels that are `du_px` beside the windows' middles.
const float* RowNormals::loaded(int du_px) const {
  const int phase = ((du_px % step_px_) + step_px_) % step_px_;
  return phases_[static_cast<std::size_t>(phase)].data() + static_cast<std::ptrdiff_t>(margin_) + (du_px - phase) / step_px_;
}

/// Sums along one row of the windows, then moments with their height.
void RowNormals::addRow(int dv_px) {
  for (Row* sum : {&row_count_, &row_u_, &row_uu_, &row_q_, &row_qu_}) {
    clear(*sum, columns_);
  }
  for (int du_px = -radius_px_; du_px <= radius_px_; du_px += stride_px_) {
    const float* __restrict inverse_depth = loaded(du_px);
    const auto du = static_cast<float>(du_px);
    for (std::size_t i = 0; i < columns_; ++i) {
      const float difference = inverse_depth[i] - centre_[i];
      const bool is_same = std::abs(difference) < max_step_share_ * centre_[i];  // false for NaN
      const float one = is_same ? 1.0F : 0.0F;
      const float kept = is_same ? difference : 0.0F;
      row_count_[i] += one;
      row_u_[i] += du * one;
      row_uu_[i] += du * du * one;
      row_q_[i] += kept;
      row_qu_[i] += du * kept;
    }
  }
  const auto dv = static_cast<float>(dv_px);
  for (std::size_t i = 0; i < columns_; ++i) {
    count_[i] += row_count_[i];
    u_[i] += row_u_[i];
    v_[i] += dv * row_count_[i];
    uu_[i] += row_uu_[i];
    uv_[i] += dv * row_u_[i];
    vv_[i] += dv * dv * row_count_[i];
    q_[i] += row_q_[i];
    qu_[i] += row_qu_[i];
    qv_[i] += dv * row_q_[i];
  }
}

/// Least squares of q = a * du + b * dv + c by Cramer's rule; the moments are whole numbers, so that readings on a line give exactly 0.
void RowNormals::solve(int v_px) {
  const auto fx = static_cast<float>(camera_.fx);
  const auto fy = static_cast<float>(camera_.fy);
  const auto below = static_cast<float>(v_px - camera_.cy);
  for (std::size_t i = 0; i < columns_; ++i) {
    const float n = count_[i];
    const float uu_cofactor = vv_[i] * n - v_[i] * v_[i];
    const float uv_cofactor = u_[i] * v_[i] - uv_[i] * n;
    const float u_cofactor = uv_[i] * v_[i] - vv_[i] * u_[i];
    const float vv_cofactor = uu_[i] * n - u_[i] * u_[i];
    const float v_cofactor = uv_[i] * u_[i] - uu_[i] * v_[i];
    const float n_cofactor = uu_[i] * vv_[i] - uv_[i] * uv_[i];
    const float per_determinant = 1.0F / (uu_[i] * uu_cofactor + uv_[i] * uv_cofactor + u_[i] * u_cofactor);
    const float a = (uu_cofactor * qu_[i] + uv_cofactor * qv_[i] + u_cofactor * q_[i]) * per_determinant;
    const float b = (uv_cofactor * qu_[i] + vv_cofactor * qv_[i] + v_cofactor * q_[i]) * per_determinant;
    const float c = (u_cofactor * qu_[i] + v_cofactor * qv_[i] + n_cofactor * q_[i]) * per_determinant + centre_[i];
    const float right = static_cast<float>(i) * static_cast<float>(step_px_) - static_cast<float>(camera_.cx);
    const float x = a * fx;
    const float y = b * fy;
    const float z = c - a * right - b * below;
    const float length = std::sqrt(x * x + y * y + z * z);
    const bool is_fit = 2.0F * n >= rows_in_image_ * samples_of_row_[i] && length > 0.0F && length < 1e6F;  // false for NaN
    const float scale = is_fit ? -1.0F / length : 0.0F;  // q > 0: the plane's normal points away from the camera
    x_[i] = is_fit ? x * scale : 0.0F;
    y_[i] = is_fit ? y * scale : 0.0F;
    z_[i] = is_fit ? z * scale : 0.0F;
  }
}

}  // namespace oikos::registration
