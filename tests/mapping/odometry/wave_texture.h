// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

namespace oikos::mapping {

/// A texture on the plane that can be sampled anywhere: a sum of plane waves of 9 to 60 pixels in random directions, so that what
/// is right between the pixels is known.
class WaveTexture {
 public:
  explicit WaveTexture(std::uint64_t seed) : random_(seed) {
    constexpr int kWaves = 24;
    for (int i = 0; i < kWaves; ++i) {
      const double wavelength_px = 9.0 * std::pow(60.0 / 9.0, uniform());
      const double angle_rad = 2.0 * std::numbers::pi * uniform();
      const Eigen::Vector2d frequency = 2.0 * std::numbers::pi / wavelength_px * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
      waves_.push_back({frequency, 2.0 * std::numbers::pi * uniform()});
    }
  }

  /// About 128 with a deviation of about 35.
  [[nodiscard]] double at(const Eigen::Vector2d& px) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) {
      sum += std::sin(wave.frequency.dot(px) + wave.phase);
    }
    return 128.0 + 10.0 * sum;
  }

  /// Samples `gray(pixel)` at the pixels' centres.
  template <class Function>
  static cv::Mat sample(const cv::Size& size, const Function& gray) {
    cv::Mat image(size, CV_8UC1);
    for (int v = 0; v < size.height; ++v) {
      for (int u = 0; u < size.width; ++u) {
        image.at<unsigned char>(v, u) = cv::saturate_cast<unsigned char>(gray(Eigen::Vector2d(u, v)));
      }
    }
    return image;
  }

  [[nodiscard]] cv::Mat image(const cv::Size& size) const {
    return sample(size, [&](const Eigen::Vector2d& px) { return at(px); });
  }

 private:
  struct Wave {
    Eigen::Vector2d frequency;
    double phase;
  };
  double uniform() { return std::uniform_real_distribution<double>()(random_); }

  std::mt19937_64 random_;
  std::vector<Wave> waves_;
};

}  // namespace oikos::mapping
