// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/auto_exposure.h"

#include <algorithm>
#include <cmath>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/geometry/tone_curve.h"

namespace oikos::camera {

std::vector<std::string> AutoExposureConfig::validate() const {
  base::ConfigRules rules;
  rules.between("target_light", target_light, 0.01, 0.9).between("speed", speed, 0.0, 1.0).between("lag_frames", lag_frames, 0, 30);
  rules.atLeast("tolerance_stops", tolerance_stops, 0.0).greater("max_step_stops", max_step_stops, 0.0);
  rules.greater("min_time_s", min_time_s, 0.0).atLeast("max_time_s", max_time_s, min_time_s).between("max_gain", max_gain, 1.0, 1000.0);
  return rules.messages();
}

AutoExposure::AutoExposure(const AutoExposureConfig& config, const Exposure& initial)
    : config_(config), stops_(std::log2(initial.product_s())), pending_(static_cast<std::size_t>(config.lag_frames), 0.0) {
  OIKOS_CHECK(config.validate().empty());
}

Exposure AutoExposure::current() const {
  const double product_s = std::exp2(stops_);
  Exposure exposure;
  exposure.time_s = std::clamp(product_s, config_.min_time_s, config_.max_time_s);
  exposure.gain = std::clamp(product_s / exposure.time_s, 1.0, config_.max_gain);
  return exposure;
}

void AutoExposure::observe(double mean_light) {
  constexpr double kDarkest = 1e-4;
  const double error_stops = std::log2(config_.target_light / std::max(mean_light, kDarkest));
  const double wanted = std::abs(error_stops) > config_.tolerance_stops ? config_.speed * error_stops : 0.0;
  pending_.push_back(std::clamp(wanted, -config_.max_step_stops, config_.max_step_stops));
  const double least = std::log2(config_.min_time_s);
  const double most = std::log2(config_.max_time_s * config_.max_gain);
  stops_ = std::clamp(stops_ + pending_.front(), least, most);
  pending_.pop_front();
}

double measureMeanLight(const cv::Mat& color) {
  OIKOS_CHECK(color.type() == CV_8UC3 && !color.empty());
  const geometry::ToneCurve& curve = geometry::ToneCurve::instance();
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v < color.rows; v += 4) {
    const auto* row = color.ptr<std::uint8_t>(v);
    for (int u = 0; u < color.cols; u += 4) {
      for (int channel = 0; channel < 3; ++channel) {
        sum += static_cast<double>(curve.toLight(row[3 * u + channel]));
      }
      count += 3;
    }
  }
  return sum / count;
}

}  // namespace oikos::camera
