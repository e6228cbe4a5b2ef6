// SPDX-License-Identifier: Apache-2.0
// Noise: the Poisson-Gaussian model of Foi, Trimeche, Katkovnik & Egiazarian, "Practical Poissonian-Gaussian Noise Modeling and Fitting for
// Single-Image Raw-Data", IEEE Transactions on Image Processing 2008, doi:10.1109/TIP.2008.2001399. Left out: demosaicing, and with it
// the noise's correlation between pixels and channels.
#include "core/camera/sensor/color_sensor.h"

#include <algorithm>
#include <cmath>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/camera/sensor/hash_noise.h"
#include "core/geometry/tone_curve.h"

namespace oikos::camera {

namespace {

constexpr int kChannels = 4;  // three and one of padding: whole vectors

/// Three or four channels of light to four.
void fillLight(const cv::Mat& color, int v, float* light) {
  const geometry::ToneCurve& curve = geometry::ToneCurve::instance();
  const bool is_stored = color.type() == CV_8UC3;
  const auto* bytes = color.ptr<std::uint8_t>(v);
  const auto* floats = color.ptr<float>(v);
  for (int u = 0; u < color.cols; ++u) {
    for (int c = 0; c < 3; ++c) {
      light[kChannels * u + c] = is_stored ? curve.toLight(bytes[3 * u + c]) : floats[3 * u + c];
    }
    light[kChannels * u + 3] = 0.0F;
  }
}

cv::Mat toLight(const cv::Mat& color, int threads) {
  cv::Mat light(color.size(), CV_32FC4);
  base::parallelFor(color.rows, threads, [&](int v) { fillLight(color, v, light.ptr<float>(v)); });
  return light;
}

/// What multiplies the light of each pixel: exposure and vignetting.
void fillFactors(const PinholeCamera& camera, int v, float vignetting, float exposure, float* factors) {
  const auto y = static_cast<float>((v - camera.cy) / camera.fy);
  const auto per_px = static_cast<float>(1.0 / camera.fx);
  const auto centre_px = static_cast<float>(camera.cx);
  for (int u = 0; u < camera.width; ++u) {
    const float x = (static_cast<float>(u) - centre_px) * per_px;
    const float cosine_sq = 1.0F / (1.0F + x * x + y * y);
    factors[u] = exposure * (1.0F - vignetting + vignetting * cosine_sq * cosine_sq);
  }
}

struct NoiseLevels {
  NoiseLevels(double gain, const ColorSensorConfig& config) {
    if (config.full_well_e > 0.0) {
      const double read = gain * config.read_noise_e / config.full_well_e;
      per_light = static_cast<float>(gain / config.full_well_e);
      at_dark = static_cast<float>(read * read);
    }
  }
  float per_light = 0.0F;  ///< variance
  float at_dark = 0.0F;
};

/// Standard normal numbers, four a pixel, of which the last is unused.
void fillNoise(const NoiseStream& stream, const GaussianTable& table, std::uint64_t first, int width, float* noise) {
  for (int u = 0; u < width; ++u) {
    const std::uint64_t bits = stream.bits(first + static_cast<std::uint64_t>(u));
    for (unsigned c = 0; c < 3; ++c) {
      noise[kChannels * u + static_cast<int>(c)] = toGaussian(table, bits >> (c * 20U));
    }
    noise[kChannels * u + 3] = 0.0F;
  }
}

struct RowScratch {
  explicit RowScratch(int width)
      : light(static_cast<std::size_t>(kChannels * width)), noise(light.size()), factors(static_cast<std::size_t>(width)) {}
  std::vector<float> light, noise, factors;
};

void addNoise(const NoiseLevels& levels, RowScratch& row) {
  const std::size_t count = row.light.size();
  float* __restrict light = row.light.data();
  const float* __restrict noise = row.noise.data();
  const float* __restrict factors = row.factors.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float exposed = light[i] * factors[i / kChannels];
    light[i] = exposed + std::sqrt(levels.at_dark + levels.per_light * exposed) * noise[i];
  }
}

void storeRow(const RowScratch& row, int width, std::uint8_t* bytes) {
  const geometry::ToneCurve& curve = geometry::ToneCurve::instance();
  for (int u = 0; u < width; ++u) {
    for (int c = 0; c < 3; ++c) {
      bytes[3 * u + c] = curve.toByte(row.light[static_cast<std::size_t>(kChannels * u + c)]);
    }
  }
}

void checkScene(const ColorScene& scene, const ColorShot& shot) {
  const cv::Size size(scene.camera.width, scene.camera.height);
  OIKOS_CHECK((scene.color.type() == CV_8UC3 || scene.color.type() == CV_32FC3) && scene.color.size() == size);
  OIKOS_CHECK(shot.motion.isStill() || (scene.depth_m.type() == CV_32FC1 && scene.depth_m.size() == size));
}

}  // namespace

std::vector<std::string> ColorSensorConfig::validate() const {
  base::ConfigRules rules;
  rules.greater("reference_exposure_s", reference_exposure_s, 0.0).between("vignetting", vignetting, 0.0, 1.0);
  rules.atLeast("full_well_e", full_well_e, 0.0).atLeast("read_noise_e", read_noise_e, 0.0).between("blur_samples", blur_samples, 1, 64);
  return rules.messages();
}

double colorNoiseSigma(double light, double gain, const ColorSensorConfig& config) {
  const NoiseLevels levels(gain, config);
  return std::sqrt(static_cast<double>(levels.at_dark) + static_cast<double>(levels.per_light) * light);
}

cv::Mat senseColor(const ColorScene& scene, const ColorShot& shot, const ColorSensorConfig& config, const SensorRun& run) {
  checkScene(scene, shot);
  const bool is_still = shot.motion.isStill();
  const cv::Mat light = is_still ? cv::Mat() : toLight(scene.color, run.threads);
  const ShutterWarp warp(scene.camera, shot.motion, {shot.exposure.time_s, config.blur_samples});
  const auto exposure = static_cast<float>(shot.exposure.product_s() / config.reference_exposure_s);
  const NoiseLevels levels(shot.exposure.gain, config);
  const NoiseStream stream(run, NoiseUse::kColor);
  const int width = scene.camera.width;
  cv::Mat recorded(scene.color.size(), CV_8UC3);
  base::parallelFor(scene.camera.height, run.threads, [&](int v) {
    RowScratch row(width);
    if (is_still) {
      fillLight(scene.color, v, row.light.data());
    } else {
      warp.fillRow(light, scene.depth_m, v, row.light.data());
    }
    fillFactors(scene.camera, v, static_cast<float>(config.vignetting), exposure, row.factors.data());
    fillNoise(stream, gaussianTable(), static_cast<std::uint64_t>(v) * static_cast<std::uint64_t>(width), width, row.noise.data());
    addNoise(levels, row);
    storeRow(row, width, recorded.ptr<std::uint8_t>(v));
  });
  return recorded;
}

}  // namespace oikos::camera
