// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/ideal_view.h"
#include "core/camera/sensor/kinect1.h"
#include "core/camera/sensor/kinect2.h"

namespace oikos::camera {

enum class DepthSensorKind { kIdeal, kKinect1, kKinect2 };
constexpr auto enumTable(DepthSensorKind) {
  return std::to_array<base::EnumName<DepthSensorKind>>(
      {{DepthSensorKind::kIdeal, "ideal"}, {DepthSensorKind::kKinect1, "kinect1"}, {DepthSensorKind::kKinect2, "kinect2"}});
}

struct DepthSensorConfig {
  DepthSensorKind kind = DepthSensorKind::kKinect1;
  double units_per_m = 1000.0;  ///< of the depth image
  double scale_error = 0.0;     ///< readings are too long by this share: 0.005 is half a percent; not of the ideal sensor
  Kinect1Config kinect1;
  Kinect2Config kinect2;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("kind", kind);
    visitor("units_per_m", units_per_m);
    visitor("scale_error", scale_error);
    visitor("kinect1", kinect1);
    visitor("kinect2", kinect2);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// The pinhole of a sensor as it is usually delivered: Kinect 1 registered to colour (OpenNI's default), Kinect 2 with 512×424 pixels of
/// its own.
[[nodiscard]] PinholeCamera nominalDepthCamera(DepthSensorKind kind);

/// What a sensor records of a view from `camera`: CV_16UC1 in depth units, 0 = no reading. Readings that do not fit 16 bits are none.
/// A pure function; its cost is that of one pass over the image, on `run.threads` threads.
[[nodiscard]] cv::Mat senseDepth(const IdealView& view, const PinholeCamera& camera, const DepthSensorConfig& config, const SensorRun& run);

}  // namespace oikos::camera
