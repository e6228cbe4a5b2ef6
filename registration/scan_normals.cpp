// SPDX-License-Identifier: Apache-2.0
#include "registration/scan_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

namespace oikos::registration {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Eight neighbouring columns at once; GCC and Clang make one instruction of what is done to all of them.
using Lanes = float __attribute__((vector_size(32)));
using Mask = std::int32_t __attribute__((vector_size(32)));
constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(float);

Lanes loadLanes(const float* from) {
  Lanes lanes;
  std::copy_n(from, kLanes, reinterpret_cast<float*>(&lanes));
  return lanes;
}

Lanes kept(const Mask& mask, const Lanes& lanes) {
  return reinterpret_cast<Lanes>(mask & reinterpret_cast<Mask>(lanes));
}

Lanes absolute(const Lanes& lanes) {
  return lanes < 0.0F ? -lanes : lanes;
}

std::size_t blocksOf(std::size_t columns) {
  return (columns + kLanes - 1) / kLanes;
}

}  // namespace

/// Sums over the windows: how many readings, their places in the window, their inverse depth q less the centre's.
struct RowNormals::Moments {
  Lanes count{}, u{}, v{}, uu{}, uv{}, vv{}, q{}, qu{}, qv{};
};

RowNormals::RowNormals(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const ScanConfig& config)
    : depth_m_(depth_m),
      camera_(camera),
      step_px_(config.step_px),
      radius_px_(config.normal_radius_px),
      max_step_share_(static_cast<float>(config.max_step_share)),
      columns_(kLanes * blocksOf(static_cast<std::size_t>((camera.width + config.step_px - 1) / config.step_px))),
      margin_(static_cast<std::size_t>((config.normal_radius_px + config.step_px - 1) / config.step_px)),
      rows_(static_cast<std::size_t>(2 * config.normal_radius_px + 1),
            Row(static_cast<std::size_t>(config.step_px) * (columns_ + 2 * margin_), kNone)),
      samples_of_row_(columns_, 0.0F),
      x_(columns_),
      y_(columns_),
      z_(columns_) {
  for (int du = -radius_px_; du <= radius_px_; du += std::max(1, radius_px_ / 2)) {
    samples_.push_back(du);
    offset_of_sample_.push_back(offsetOf(du));
    for (std::size_t i = 0; i < columns_; ++i) {
      const int u = static_cast<int>(i) * step_px_ + du;
      samples_of_row_[i] += u >= 0 && u < camera_.width ? 1.0F : 0.0F;
    }
  }
}

void RowNormals::fit(int v_px) {
  for (; next_row_ <= std::min(v_px + radius_px_, camera_.height - 1); ++next_row_) {
    load(next_row_);
  }
  sampled_rows_.clear();
  for (const int dv : samples_) {
    if (v_px + dv >= 0 && v_px + dv < camera_.height) {
      sampled_rows_.push_back({rowOf(v_px + dv).data(), static_cast<float>(dv)});
    }
  }
  const float* const centre = rowOf(v_px).data() + offsetOf(0);
  for (std::size_t first = 0; first < columns_; first += kLanes) {
    solve(first, static_cast<float>(v_px), momentsOf(first, centre + first));
  }
}

void RowNormals::load(int v_px) {
  const float* const depth_m = depth_m_.ptr<float>(v_px);
  for (int phase = 0; phase < step_px_; ++phase) {
    float* const to = rowOf(v_px).data() + offsetOf(phase);
    const int columns = (camera_.width - phase + step_px_ - 1) / step_px_;
    for (int i = 0; i < columns; ++i) {
      to[i] = 1.0F / depth_m[i * step_px_ + phase];
    }
  }
}

/// Where in a row the pixels begin that are `du_px` beside the windows' middles.
std::size_t RowNormals::offsetOf(int du_px) const {
  const int phase = ((du_px % step_px_) + step_px_) % step_px_;
  const std::size_t of_phase = static_cast<std::size_t>(phase) * (columns_ + 2 * margin_);
  return of_phase + static_cast<std::size_t>(static_cast<int>(margin_) + (du_px - phase) / step_px_);
}

RowNormals::Moments RowNormals::momentsOf(std::size_t first, const float* centre) const {
  const Lanes middle = loadLanes(centre);
  const Lanes most = max_step_share_ * middle;
  const Lanes one = Lanes{} + 1.0F;
  Moments sum;
  for (const SampledRow& row : sampled_rows_) {
    Lanes count{};
    Lanes u{};
    Lanes uu{};
    Lanes q{};
    Lanes qu{};
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      const Lanes difference = loadLanes(row.inverse_depth + offset_of_sample_[k] + first) - middle;
      const Mask is_same = absolute(difference) < most;  // false for NaN
      const Lanes here = kept(is_same, one);
      const Lanes same = kept(is_same, difference);
      const auto du = static_cast<float>(samples_[k]);
      count += here;
      u += du * here;
      uu += du * du * here;
      q += same;
      qu += du * same;
    }
    sum.count += count;
    sum.u += u;
    sum.v += row.dv_px * count;
    sum.uu += uu;
    sum.uv += row.dv_px * u;
    sum.vv += row.dv_px * row.dv_px * count;
    sum.q += q;
    sum.qu += qu;
    sum.qv += row.dv_px * q;
  }
  return sum;
}

/// Least squares of q = a * du + b * dv + c by Cramer's rule; the moments are whole numbers, so that readings on a line give exactly 0.
void RowNormals::solve(std::size_t first, float v_px, const Moments& m) {
  const Lanes uu_cofactor = m.vv * m.count - m.v * m.v;
  const Lanes uv_cofactor = m.u * m.v - m.uv * m.count;
  const Lanes u_cofactor = m.uv * m.v - m.vv * m.u;
  const Lanes vv_cofactor = m.uu * m.count - m.u * m.u;
  const Lanes v_cofactor = m.uv * m.u - m.uu * m.v;
  const Lanes n_cofactor = m.uu * m.vv - m.uv * m.uv;
  const Lanes per_determinant = 1.0F / (m.uu * uu_cofactor + m.uv * uv_cofactor + m.u * u_cofactor);
  const Lanes a = (uu_cofactor * m.qu + uv_cofactor * m.qv + u_cofactor * m.q) * per_determinant;
  const Lanes b = (uv_cofactor * m.qu + vv_cofactor * m.qv + v_cofactor * m.q) * per_determinant;
  const Lanes c = (u_cofactor * m.qu + v_cofactor * m.qv + n_cofactor * m.q) * per_determinant;
  const float* const centre = rowOf(static_cast<int>(v_px)).data() + offsetOf(0) + first;
  const auto fx = static_cast<float>(camera_.fx);
  const auto fy = static_cast<float>(camera_.fy);
  const float below = v_px - static_cast<float>(camera_.cy);
  const auto rows_in_image = static_cast<float>(sampled_rows_.size());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t i = first + lane;
    const float right = static_cast<float>(i) * static_cast<float>(step_px_) - static_cast<float>(camera_.cx);
    const float x = a[lane] * fx;
    const float y = b[lane] * fy;
    const float z = c[lane] + centre[lane] - a[lane] * right - b[lane] * below;
    const float length = std::sqrt(x * x + y * y + z * z);
    const bool is_fit = 2.0F * m.count[lane] >= rows_in_image * samples_of_row_[i] && length > 0.0F && length < 1e6F;  // false for NaN
    const float scale = is_fit ? -1.0F / length : 0.0F;  // q > 0: the plane's normal points away from the camera
    x_[i] = is_fit ? x * scale : 0.0F;
    y_[i] = is_fit ? y * scale : 0.0F;
    z_[i] = is_fit ? z * scale : 0.0F;
  }
}

}  // namespace oikos::registration
