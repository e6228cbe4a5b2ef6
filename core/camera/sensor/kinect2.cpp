// SPDX-License-Identifier: Apache-2.0
// Noise: Fankhauser, Bloesch, Rodriguez, Kaestner, Hutter & Siegwart, "Kinect v2 for Mobile Robot Navigation: Evaluation and Modeling",
// ICAR 2015, doi:10.1109/ICAR.2015.7251485 (fitted from 0.7 to 3.1 m and 0 to 75 degrees; used beyond too). Flying pixels and the effect
// of dark surfaces as described by Wasenmüller & Stricker, "Comparison of Kinect v1 and v2 Depth Images in Terms of Accuracy and
// Precision", ACCV Workshops 2016, doi:10.1007/978-3-319-54427-4_3. That noise grows with 1/sqrt(light) is the limit of shot noise, and
// not from these papers. Left out: wiggling, the drift with temperature, multipath and highlights.
#include "core/camera/sensor/kinect2.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/config_rules.h"
#include "core/base/parallel.h"
#include "core/camera/sensor/hash_noise.h"
#include "core/camera/sensor/incidence.h"

namespace oikos::camera {

namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
constexpr float kDarkest = 0.01F;  // darker surfaces are no noisier than this one; they drop out

float axialSigma(float z_m, float cosine) {
  const float ratio = incidenceRatio(cosine);
  return 0.001F * (1.5F - 0.5F * z_m + 0.3F * z_m * z_m + 0.1F * z_m * std::sqrt(z_m) * ratio * ratio);
}

struct Row {
  Row(const IdealView& view, int v)
      : depth_m(view.depth_m.ptr<float>(v)), reflectivity(view.reflectivity.ptr<float>(v)), gloss(view.gloss.ptr<float>(v)) {}
  /// Light that a matt surface sends back.
  [[nodiscard]] float brightness(int u) const { return reflectivity[u] * (1.0F - gloss[u]); }
  const float* depth_m;
  const float* reflectivity;
  const float* gloss;
};

/// How far three neighbours are from one plane: along a line of pixels the inverse depth of a plane is linear.
float departure(float before_m, float here_m, float after_m) {
  return std::abs(1.0F / before_m - 2.0F / here_m + 1.0F / after_m) * here_m * here_m;
}

class TimeOfFlight {
 public:
  TimeOfFlight(const IdealView& view, const PinholeCamera& camera, const Kinect2Config& config, const SensorRun& run)
      : view_(view),
        camera_(camera),
        config_(config),
        axial_(run, NoiseUse::kAxial),
        signal_(run, NoiseUse::kSignal),
        flying_(run, NoiseUse::kFlyingPixel),
        table_(gaussianTable()) {}

  void senseRow(int v, float* readings_m) const {
    std::vector<float> cosines(static_cast<std::size_t>(camera_.width));
    fillIncidenceCosines(view_.normal_camera, camera_, v, cosines.data());
    for (int u = 0; u < camera_.width; ++u) {
      readings_m[u] = sense({u, v}, cosines[static_cast<std::size_t>(u)]);
    }
  }

 private:
  [[nodiscard]] std::uint64_t counter(const cv::Point& pixel) const {
    return static_cast<std::uint64_t>(pixel.y) * static_cast<std::uint64_t>(camera_.width) + static_cast<std::uint64_t>(pixel.x);
  }

  [[nodiscard]] float sense(const cv::Point& pixel, float cosine) const {
    const Row row(view_, pixel.y);
    if (!returnsLight(pixel, row, cosine)) {
      return kNoReading;
    }
    float z_m = row.depth_m[pixel.x];
    if (isEdge(pixel)) {
      if (toUniform(flying_.bits(counter(pixel))) < static_cast<float>(config_.edge_dropout)) {
        return kNoReading;
      }
      z_m = mixNeighbours(pixel);
    }
    const float light = std::max(row.brightness(pixel.x), kDarkest) / static_cast<float>(config_.reference_reflectivity);
    const float sigma_m = axialSigma(z_m, cosine) / std::sqrt(light) * static_cast<float>(config_.noise_scale);
    const float reading_m = z_m + sigma_m * toGaussian(table_, axial_.bits(counter(pixel)));
    const bool in_range = reading_m >= static_cast<float>(config_.min_range_m) && reading_m <= static_cast<float>(config_.max_range_m);
    return in_range ? reading_m : kNoReading;
  }

  /// False for NaN too.
  [[nodiscard]] bool returnsLight(const cv::Point& pixel, const Row& row, float cosine) const {
    const float z_m = row.depth_m[pixel.x];
    const float signal = row.brightness(pixel.x) * cosine / (z_m * z_m) / static_cast<float>(config_.min_signal);
    const float noise = toGaussian(table_, signal_.bits(counter(pixel)));
    const float threshold = std::max(1.0F + static_cast<float>(config_.dropout_softness) * noise, 0.0F);
    return signal > threshold && cosine / static_cast<float>(config_.min_cosine) > threshold;
  }

  [[nodiscard]] bool isEdge(const cv::Point& pixel) const {
    if (pixel.x == 0 || pixel.y == 0 || pixel.x == camera_.width - 1 || pixel.y == camera_.height - 1) {
      return false;
    }
    const float* row = view_.depth_m.ptr<float>(pixel.y);
    const float* above = view_.depth_m.ptr<float>(pixel.y - 1);
    const float* below = view_.depth_m.ptr<float>(pixel.y + 1);
    const auto step_m = static_cast<float>(config_.edge_step_m);
    const float here_m = row[pixel.x];
    return departure(row[pixel.x - 1], here_m, row[pixel.x + 1]) > step_m || departure(above[pixel.x], here_m, below[pixel.x]) > step_m;
  }

  /// The mean of what falls into the pixel, by the light that comes back: a small kernel (1 2 1)×(1 2 1).
  [[nodiscard]] float mixNeighbours(const cv::Point& pixel) const {
    constexpr float kWeights[] = {1.0F, 2.0F, 1.0F};
    float sum = 0.0F;
    float sum_weights = 0.0F;
    for (int dv = -1; dv <= 1; ++dv) {
      const Row row(view_, pixel.y + dv);
      for (int du = -1; du <= 1; ++du) {
        const float z_m = row.depth_m[pixel.x + du];
        const float weight = kWeights[dv + 1] * kWeights[du + 1] * row.brightness(pixel.x + du) / (z_m * z_m);
        if (weight > 0.0F) {
          sum += weight * z_m;
          sum_weights += weight;
        }
      }
    }
    return sum / sum_weights;
  }

  const IdealView& view_;
  const PinholeCamera& camera_;
  const Kinect2Config& config_;
  NoiseStream axial_;
  NoiseStream signal_;
  NoiseStream flying_;
  const GaussianTable& table_;
};

}  // namespace

std::vector<std::string> Kinect2Config::validate() const {
  base::ConfigRules rules;
  rules.between("noise_scale", noise_scale, 0.0, 10.0).between("reference_reflectivity", reference_reflectivity, 0.01, 1.0);
  rules.greater("edge_step_m", edge_step_m, 0.0).between("edge_dropout", edge_dropout, 0.0, 1.0);
  rules.greater("min_signal", min_signal, 0.0).between("min_cosine", min_cosine, 0.01, 1.0);
  rules.between("dropout_softness", dropout_softness, 0.0, 1.0);
  rules.between("min_range_m", min_range_m, 0.1, 10.0).greater("max_range_m", max_range_m, min_range_m);
  return rules.messages();
}

double kinect2AxialSigma_m(double z_m, double theta_rad) {
  return static_cast<double>(axialSigma(static_cast<float>(z_m), static_cast<float>(std::cos(theta_rad))));
}

cv::Mat senseKinect2(const IdealView& view, const PinholeCamera& camera, const Kinect2Config& config, const SensorRun& run) {
  const TimeOfFlight sensor(view, camera, config, run);
  cv::Mat readings_m(view.depth_m.size(), CV_32FC1);
  base::parallelFor(camera.height, run.threads, [&](int v) { sensor.senseRow(v, readings_m.ptr<float>(v)); });
  return readings_m;
}

}  // namespace oikos::camera
