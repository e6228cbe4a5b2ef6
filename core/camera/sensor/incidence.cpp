// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/incidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oikos::camera {

namespace {

constexpr std::size_t kSteps = 1024;
using RatioTable = std::array<float, kSteps + 2>;

RatioTable makeRatioTable() {
  constexpr double kSteepest_rad = 85.0 / 180.0 * std::numbers::pi;
  RatioTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double cosine = std::min(1.0, static_cast<double>(i) / kSteps);
    const double theta_rad = std::min(std::acos(cosine), kSteepest_rad);
    table[i] = static_cast<float>(theta_rad / (0.5 * std::numbers::pi - theta_rad));
  }
  return table;
}

}  // namespace

void fillIncidenceCosines(const cv::Mat& normal_camera, const PinholeCamera& camera, int v, float* cosines) {
  const float* normals = normal_camera.ptr<float>(v);
  const auto y = static_cast<float>((v - camera.cy) / camera.fy);
  const auto per_px = static_cast<float>(1.0 / camera.fx);
  const auto centre_px = static_cast<float>(camera.cx);
  for (int u = 0; u < normal_camera.cols; ++u) {
    const float x = (static_cast<float>(u) - centre_px) * per_px;
    const float along = -(x * normals[3 * u] + y * normals[3 * u + 1] + normals[3 * u + 2]);
    const float cosine = along / std::sqrt(1.0F + x * x + y * y);
    cosines[u] = cosine > 0.0F ? cosine : 0.0F;  // NaN too
  }
}

float incidenceRatio(float cosine) {
  static const RatioTable kTable = makeRatioTable();
  const float position = std::clamp(cosine, 0.0F, 1.0F) * static_cast<float>(kSteps);
  const auto index = static_cast<std::size_t>(position);
  const float fraction = position - static_cast<float>(index);
  return kTable[index] + fraction * (kTable[index + 1] - kTable[index]);
}

}  // namespace oikos::camera
