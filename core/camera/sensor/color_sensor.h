// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/auto_exposure.h"
#include "core/camera/sensor/ideal_view.h"
#include "core/camera/sensor/shutter_motion.h"

namespace oikos::camera {

struct ColorSensorConfig {
  double reference_exposure_s = 0.012;  ///< with this exposure and gain 1 the ideal image is reproduced
  double vignetting = 0.5;              ///< 0: none, 1: the cos^4 of a simple lens
  double full_well_e = 6000.0;          ///< electrons of a saturated pixel at gain 1; 0: no noise
  double read_noise_e = 12.0;           ///< deviation, electrons
  int blur_samples = 8;                 ///< at most so many along a pixel's flow

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("reference_exposure_s", reference_exposure_s);
    visitor("vignetting", vignetting);
    visitor("full_well_e", full_well_e);
    visitor("read_noise_e", read_noise_e);
    visitor("blur_samples", blur_samples);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// What is before the camera.
struct ColorScene {
  PinholeCamera camera;
  cv::Mat color;    ///< CV_8UC3 (sRGB), or CV_32FC3 light, 1 = saturated at the reference exposure and brighter light allowed; BGR
  cv::Mat depth_m;  ///< CV_32FC1, NaN = far away; may be empty if nothing moves
};

/// What is set and done while the image is taken.
struct ColorShot {
  Exposure exposure;
  ShutterMotion motion;
};

/// Deviation of the noise of a pixel that receives `light` (1 = saturated) at a gain: Poisson noise of the electrons and read noise.
[[nodiscard]] double colorNoiseSigma(double light, double gain, const ColorSensorConfig& config);

/// The recorded image, CV_8UC3, BGR. A pure function.
[[nodiscard]] cv::Mat senseColor(const ColorScene& scene, const ColorShot& shot, const ColorSensorConfig& config, const SensorRun& run);

}  // namespace oikos::camera
