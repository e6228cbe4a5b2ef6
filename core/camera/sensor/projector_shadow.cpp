// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/projector_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace oikos::camera {

ProjectorShadow::ProjectorShadow(int width, float units_per_px)
    : width_(width),
      offset_px_(static_cast<int>(std::ceil(static_cast<float>(kMaxDisparity) / units_per_px)) + 1),
      px_per_unit_(1.0F / units_per_px),
      step_(static_cast<std::int16_t>(std::lround(units_per_px))),
      nearest_(static_cast<std::size_t>(width + offset_px_ + 1)) {}

int ProjectorShadow::projectorColumn(int u, std::int16_t disparity) const {
  return static_cast<int>(static_cast<float>(u + offset_px_) - static_cast<float>(disparity) * px_per_unit_ + 0.5F);
}

void ProjectorShadow::light(const std::int16_t* disparities) {
  std::fill(nearest_.begin(), nearest_.end(), kNoDisparity);
  int column_before = 0;
  std::int16_t before = kNoDisparity;
  for (int u = 0; u < width_; ++u) {
    const std::int16_t disparity = disparities[u];
    if (disparity != kNoDisparity) {
      const int column = projectorColumn(u, disparity);
      // a slanted surface is wider for the projector than for the camera: leave no gaps in it
      const bool same_surface = std::abs(disparity - before) <= step_;
      const int first = same_surface ? std::min(column, column_before + 1) : column;
      for (int c = first; c <= column; ++c) {
        nearest_[static_cast<std::size_t>(c)] = std::max(nearest_[static_cast<std::size_t>(c)], disparity);
      }
      column_before = column;
    }
    before = disparity;
  }
}

void ProjectorShadow::darken(std::int16_t* disparities) {
  light(disparities);
  for (int u = 0; u < width_; ++u) {
    const std::int16_t disparity = disparities[u];
    if (disparity != kNoDisparity && nearest_[static_cast<std::size_t>(projectorColumn(u, disparity))] > disparity + step_) {
      disparities[u] = kNoDisparity;
    }
  }
}

}  // namespace oikos::camera
