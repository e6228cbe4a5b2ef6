// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/depth_sensor.h"

#include <cstdint>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace oikos::camera {

namespace {

cv::Mat toUnits(const cv::Mat& depth_m, double units_per_m, int threads) {
  cv::Mat stored(depth_m.size(), CV_16UC1);
  const auto scale = static_cast<float>(units_per_m);
  base::parallelFor(depth_m.rows, threads, [&](int v) {
    const auto* metres = depth_m.ptr<float>(v);
    auto* units = stored.ptr<std::uint16_t>(v);
    for (int u = 0; u < depth_m.cols; ++u) {
      const float value = metres[u] * scale + 0.5F;
      units[u] = static_cast<std::uint16_t>(value > 0.0F && value < 65535.0F ? static_cast<int>(value) : 0);  // NaN: none
    }
  });
  return stored;
}

void checkView(const IdealView& view, const PinholeCamera& camera) {
  const cv::Size size(camera.width, camera.height);
  OIKOS_CHECK(view.depth_m.type() == CV_32FC1 && view.depth_m.size() == size);
  OIKOS_CHECK(view.normal_camera.type() == CV_32FC3 && view.normal_camera.size() == size);
  OIKOS_CHECK(view.reflectivity.type() == CV_32FC1 && view.reflectivity.size() == size);
  OIKOS_CHECK(view.gloss.type() == CV_32FC1 && view.gloss.size() == size);
}

}  // namespace

std::vector<std::string> DepthSensorConfig::validate() const {
  base::ConfigRules rules;
  rules.between("units_per_m", units_per_m, 1.0, 100000.0).between("scale_error", scale_error, -0.1, 0.1);
  return rules.messages();
}

PinholeCamera nominalDepthCamera(DepthSensorKind kind) {
  if (kind == DepthSensorKind::kKinect2) {
    return {512, 424, 365.0, 365.0, 255.5, 211.5};
  }
  return {640, 480, 525.0, 525.0, 319.5, 239.5};
}

cv::Mat senseDepth(const IdealView& view, const PinholeCamera& camera, const DepthSensorConfig& config, const SensorRun& run) {
  checkView(view, camera);
  const double units_per_m = config.units_per_m * (1.0 + config.scale_error);
  switch (config.kind) {
    case DepthSensorKind::kKinect1:
      return toUnits(senseKinect1(view, camera, config.kinect1, run), units_per_m, run.threads);
    case DepthSensorKind::kKinect2:
      return toUnits(senseKinect2(view, camera, config.kinect2, run), units_per_m, run.threads);
    case DepthSensorKind::kIdeal:
      break;
  }
  return toUnits(view.depth_m, config.units_per_m, run.threads);
}

}  // namespace oikos::camera
