// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/ideal_view.h"

namespace oikos::camera {

/// A time-of-flight sensor of the kind of the second Kinect.
struct Kinect2Config {
  double noise_scale = 1.0;             ///< of the axial noise as published; 0: none
  double reference_reflectivity = 0.5;  ///< of the surfaces that the published noise was measured on
  double edge_step_m = 0.03;            ///< departure from a plane within two pixels above which light of both sides is mixed
  double edge_dropout = 0.5;            ///< share of the mixed pixels that the sensor's own filter takes away
  double min_signal = 0.004;            ///< reflectivity * cos(theta) / z² (1/m²) at which half of the readings drop out
  double min_cosine = 0.1;              ///< cos(theta) at which half of the readings drop out
  double dropout_softness = 0.3;        ///< relative deviation of these two thresholds, from pixel to pixel
  double min_range_m = 0.5;             ///< nearer surfaces give no reading
  double max_range_m = 4.5;             ///< farther readings are given as none; the sensor itself reaches 8 m, with less trust

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("noise_scale", noise_scale);
    visitor("reference_reflectivity", reference_reflectivity);
    visitor("edge_step_m", edge_step_m);
    visitor("edge_dropout", edge_dropout);
    visitor("min_signal", min_signal);
    visitor("min_cosine", min_cosine);
    visitor("dropout_softness", dropout_softness);
    visitor("min_range_m", min_range_m);
    visitor("max_range_m", max_range_m);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Deviation of a reading of a surface of the reference reflectivity; that of a darker one is larger by sqrt(reference / reflectivity).
[[nodiscard]] double kinect2AxialSigma_m(double z_m, double theta_rad);

/// CV_32FC1, metres, NaN = no reading. For 512×424 pixels, but any size will do.
[[nodiscard]] cv::Mat senseKinect2(const IdealView& view, const PinholeCamera& camera, const Kinect2Config& config, const SensorRun& run);

}  // namespace oikos::camera
