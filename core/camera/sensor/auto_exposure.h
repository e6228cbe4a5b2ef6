// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace oikos::camera {

/// What a camera sets for one image.
struct Exposure {
  double time_s = 0.012;
  double gain = 1.0;  ///< multiplies the signal and its noise

  [[nodiscard]] double product_s() const { return time_s * gain; }
};

struct AutoExposureConfig {
  double target_light = 0.18;    ///< mean light of the image to settle at, 1 = saturated
  double speed = 0.3;            ///< share of the error that an image takes away, in stops; above 0.6 the lag makes it swing
  int lag_frames = 2;            ///< images that are taken before a decision shows
  double tolerance_stops = 0.1;  ///< smaller errors are left alone
  double max_step_stops = 0.5;   ///< largest change from image to image
  double min_time_s = 0.0005;
  double max_time_s = 0.033;  ///< darker scenes raise the gain instead
  double max_gain = 16.0;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("target_light", target_light);
    visitor("speed", speed);
    visitor("lag_frames", lag_frames);
    visitor("tolerance_stops", tolerance_stops);
    visitor("max_step_stops", max_step_stops);
    visitor("min_time_s", min_time_s);
    visitor("max_time_s", max_time_s);
    visitor("max_gain", max_gain);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Follows the brightness of the images as a camera does, with lag. Its state depends on the recorded images only. Not thread-safe.
class AutoExposure {
 public:
  AutoExposure(const AutoExposureConfig& config, const Exposure& initial);

  /// Of the next image.
  [[nodiscard]] Exposure current() const;
  /// To be called once for each image, with its mean light.
  void observe(double mean_light);

 private:
  AutoExposureConfig config_;
  double stops_;                ///< log2 of the exposure's product
  std::deque<double> pending_;  ///< changes in stops, the next one first
};

/// Mean light over all channels of a recorded image, CV_8UC3, from every fourth pixel of every fourth row.
[[nodiscard]] double measureMeanLight(const cv::Mat& color);

}  // namespace oikos::camera
