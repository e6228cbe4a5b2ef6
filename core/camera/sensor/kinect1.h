// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/ideal_view.h"

namespace oikos::camera {

/// A structured-light sensor of the kind of the first Kinect and the Xtion.
struct Kinect1Config {
  double baseline_m = 0.075;         ///< the projector stands so far to the camera's right
  double disparity_step_px = 0.125;  ///< the matcher's quantisation
  double agreement_px = 0.75;        ///< pixels of a window that differ by no more match together
  double min_agreement = 0.45;       ///< share of the window's pixels that must match together, else no reading
  double noise_scale = 1.0;          ///< of the axial and lateral noise as published; 0: none
  int noise_spacing_px = 3;          ///< neighbours closer than this have similar noise
  /// reflectivity * cos(theta) / z² (1/m²), in the mean over the matcher's window, at which half of the readings drop out
  double min_signal = 0.002;
  double min_cosine = 0.17;       ///< cos(theta) at which half of the readings drop out; about 80 degrees
  double dropout_softness = 0.2;  ///< relative deviation of these two thresholds, from place to place
  int dropout_spacing_px = 9;     ///< places closer than this drop out together
  double max_highlight = 0.02;    ///< gloss² * cos(theta)^128 / z² (1/m²) above which the reflected projector dazzles
  double min_range_m = 0.5;       ///< nearer surfaces give no reading
  double max_range_m = 4.5;       ///< farther readings are given as none

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("baseline_m", baseline_m);
    visitor("disparity_step_px", disparity_step_px);
    visitor("agreement_px", agreement_px);
    visitor("min_agreement", min_agreement);
    visitor("noise_scale", noise_scale);
    visitor("noise_spacing_px", noise_spacing_px);
    visitor("min_signal", min_signal);
    visitor("min_cosine", min_cosine);
    visitor("dropout_softness", dropout_softness);
    visitor("dropout_spacing_px", dropout_spacing_px);
    visitor("max_highlight", max_highlight);
    visitor("min_range_m", min_range_m);
    visitor("max_range_m", max_range_m);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Deviation of a reading of a surface at z whose normal makes the angle theta with the ray, quantisation included.
[[nodiscard]] double kinect1AxialSigma_m(double z_m, double theta_rad);
/// Deviation of the place of an edge, across it.
[[nodiscard]] double kinect1LateralSigma_px(double theta_rad);

/// CV_32FC1, metres, NaN = no reading. Readings lie on the matcher's disparity steps. The outermost 4 pixels have none, as the matcher's
/// window must fit into the image.
[[nodiscard]] cv::Mat senseKinect1(const IdealView& view, const PinholeCamera& camera, const Kinect1Config& config, const SensorRun& run);

}  // namespace oikos::camera
