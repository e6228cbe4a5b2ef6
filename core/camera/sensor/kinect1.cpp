// SPDX-License-Identifier: Apache-2.0
// Noise: Nguyen, Izadi & Lovell, "Modeling Kinect Sensor Noise for Improved 3D Reconstruction and Tracking", 3DIMPVT 2012,
// doi:10.1109/3DIMPVT.2012.84. Disparity and its steps: Khoshelham & Elberink, "Accuracy and Resolution of Kinect Depth Data for Indoor
// Mapping Applications", Sensors 2012, doi:10.3390/s120201437. Shadow and correlation window: after Bohg, Romero, Herzog & Schaal, "Robot
// Arm Pose Estimation through Pixel-Wise Part Classification", ICRA 2014, pages 3143-3150. Unlike there, no dot pattern is drawn and
// correlated: a window's disparity is the mean of the largest group of its pixels that agree, and what the pattern's matching adds is
// Nguyen's noise. That noise is spread over disparity, less the part that the quantisation brings by itself. How far from the mirror's
// angle a highlight reaches: Sarbolandi, Lefloch & Kolb, "Kinect Range Sensing: Structured-Light versus Time-of-Flight Kinect", CVIU 2015,
// arXiv:1505.05459 (a whiteboard at 1.7 m gives nothing below 10 degrees). The thresholds of drop-outs are guesses of the right order.
#include "core/camera/sensor/kinect1.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/camera/sensor/incidence.h"
#include "core/camera/sensor/noise_field.h"
#include "core/camera/sensor/projector_shadow.h"
#include "core/camera/sensor/window_matcher.h"

namespace oikos::camera {

namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
constexpr int kBandRows = 8;  // rows that share scratch memory
constexpr float kSteepCosine = 0.5F;

// Nguyen et al., section 3, metres and pixels
constexpr float kAxial0 = 0.0012F;
constexpr float kAxialSlope = 0.0019F;
constexpr float kAxialNearest_m = 0.4F;
constexpr float kAxialSteep = 0.0001F;
constexpr float kLateral0_px = 0.8F;
constexpr float kLateralSteep_px = 0.035F;

float frontalSigma(float z_m) {
  const float from_nearest = z_m - kAxialNearest_m;
  return kAxial0 + kAxialSlope * from_nearest * from_nearest;
}

/// What a steep surface adds, times sqrt(z).
float steepSigma(float cosine) {
  if (cosine > kSteepCosine) {
    return 0.0F;
  }
  const float ratio = incidenceRatio(cosine);
  return kAxialSteep * ratio * ratio;
}

float lateralSigma(float cosine) {
  return kLateral0_px + kLateralSteep_px * incidenceRatio(cosine);
}

/// The constants of one frame.
struct Matcher {
  Matcher(const PinholeCamera& of_camera, const Kinect1Config& of_config)
      : camera(of_camera), config(of_config), focal_baseline(static_cast<float>(of_camera.fx * of_config.baseline_m)) {
    const double largest_px = 1.25 * of_camera.fx * of_config.baseline_m / of_config.min_range_m;
    units_per_px = static_cast<float>(std::min(200.0, kMaxDisparity / largest_px));
    rules.agreement = static_cast<std::int16_t>(std::lround(of_config.agreement_px * static_cast<double>(units_per_px)));
    rules.min_count = static_cast<int>(std::ceil(of_config.min_agreement * kMatchWindow_px * kMatchWindow_px));
  }
  const PinholeCamera& camera;
  const Kinect1Config& config;
  float focal_baseline;  ///< px m
  float units_per_px = 0.0F;
  MatchRules rules;
};

struct Noise {
  Noise(const SensorRun& run, const NoiseField::Shape& shape, int dropout_spacing_px)
      : axial({run, NoiseUse::kAxial}, shape, run.threads),
        across({run, NoiseUse::kLateralAcross}, shape, run.threads),
        down({run, NoiseUse::kLateralDown}, shape, run.threads),
        signal({run, NoiseUse::kSignal}, {shape.width, shape.height, dropout_spacing_px}, run.threads) {}
  NoiseField axial, across, down, signal;
};

struct RowScratch {
  explicit RowScratch(int width)
      : windows(width),
        cosine(SmoothWindows::index(width)),
        axial(cosine),
        across(cosine),
        down(cosine),
        signal(cosine),
        steep(cosine),
        disparity_px(cosine) {}
  SmoothWindows windows;
  std::vector<float> cosine, axial, across, down, signal, steep, disparity_px;
};

void fillDisparities(const Matcher& matcher, const float* depth_m, int width, std::int16_t* __restrict disparities) {
  const float scale = matcher.focal_baseline * matcher.units_per_px;
  for (int u = 0; u < width; ++u) {
    const float disparity = scale / depth_m[u] + 0.5F;
    const float bounded = disparity < static_cast<float>(kMaxDisparity) ? disparity : static_cast<float>(kMaxDisparity);
    disparities[u] = static_cast<std::int16_t>(depth_m[u] > 0.0F ? bounded : static_cast<float>(kNoDisparity));
  }
}

/// What the camera sees of the projector's light, as CV_16SC1 disparities.
cv::Mat lightScene(const IdealView& view, const Matcher& matcher, int threads) {
  const cv::Mat padded(view.depth_m.rows, view.depth_m.cols + kMatchPadding_px, CV_16SC1, cv::Scalar(kNoDisparity));
  cv::Mat disparities = padded.colRange(0, view.depth_m.cols);
  const int bands = (view.depth_m.rows + kBandRows - 1) / kBandRows;
  base::parallelFor(bands, threads, [&](int band) {
    ProjectorShadow shadow(view.depth_m.cols, matcher.units_per_px);
    for (int v = band * kBandRows; v < std::min(view.depth_m.rows, (band + 1) * kBandRows); ++v) {
      auto* row = disparities.ptr<std::int16_t>(v);
      fillDisparities(matcher, view.depth_m.ptr<float>(v), view.depth_m.cols, row);
      shadow.darken(row);
    }
  });
  return disparities;
}

/// How the disparity changes with the column and the row on the plane through a pixel: 1/z = (n · ray) / (n · p).
cv::Point2f disparityGradient(const IdealView& view, const Matcher& matcher, const cv::Point& pixel) {
  const auto& n = view.normal_camera.ptr<cv::Vec3f>(pixel.y)[pixel.x];
  const PinholeCamera& camera = matcher.camera;
  const auto x = static_cast<float>((pixel.x - camera.cx) / camera.fx);
  const auto y = static_cast<float>((pixel.y - camera.cy) / camera.fy);
  const float scale = matcher.focal_baseline / (view.depth_m.ptr<float>(pixel.y)[pixel.x] * (n[0] * x + n[1] * y + n[2]));
  const cv::Point2f gradient(scale * n[0] / static_cast<float>(camera.fx), scale * n[1] / static_cast<float>(camera.fy));
  const bool is_slope = std::abs(gradient.x) < 1.0F && std::abs(gradient.y) < 1.0F;  // else seen edge-on
  return is_slope ? gradient : cv::Point2f();
}

/// Near an edge the window looks a little beside the pixel, so that the edge wavers; on the slope of a surface that changes nothing.
float matchBesideEdge(const IdealView& view, const Matcher& matcher, const cv::Mat& disparities, const RowScratch& row,
                      const cv::Point& pixel) {
  const auto i = SmoothWindows::index(pixel.x);
  const float sigma_px = lateralSigma(row.cosine[i]) * static_cast<float>(matcher.config.noise_scale);
  // rounding to whole pixels adds 1/12
  const float moved_px = std::sqrt(std::max(0.0F, sigma_px * sigma_px - 1.0F / 12.0F));
  const auto move = [&](int at, float noise, int size) {
    return std::clamp(at + static_cast<int>(std::lround(moved_px * noise)), kMatchRadius_px, size - 1 - kMatchRadius_px);
  };
  const cv::Point moved(move(pixel.x, row.across[i], disparities.cols), move(pixel.y, row.down[i], disparities.rows));
  const float matched = matchWindow(disparities, moved.x, moved.y, matcher.rules);
  if (!(matched > 0.0F)) {
    return 0.0F;
  }
  const cv::Point2f gradient = disparityGradient(view, matcher, moved);
  const auto slope = gradient.x * static_cast<float>(pixel.x - moved.x) + gradient.y * static_cast<float>(pixel.y - moved.y);
  return matched / matcher.units_per_px + slope;
}

/// Noiseless disparities of a row in pixels, 0 = none.
void matchRow(const IdealView& view, const Matcher& matcher, const cv::Mat& disparities, int v, RowScratch& row) {
  row.windows.fill(disparities, v);
  std::fill(row.disparity_px.begin(), row.disparity_px.end(), 0.0F);
  const float px_per_unit = 1.0F / matcher.units_per_px;
  for (int u = kMatchRadius_px; u < disparities.cols - kMatchRadius_px; ++u) {
    const auto i = SmoothWindows::index(u);
    if (row.windows.isSmooth(u, matcher.rules)) {
      row.disparity_px[i] = row.windows.high[i] == kNoDisparity ? 0.0F : row.windows.mean(u) * px_per_unit;
    } else {
      row.disparity_px[i] = matchBesideEdge(view, matcher, disparities, row, {u, v});
    }
  }
}

/// How much of the pattern comes back to each pixel, in the mean over the window that is correlated with it.
cv::Mat gatherSignals(const IdealView& view, const PinholeCamera& camera, int threads) {
  cv::Mat signals(view.depth_m.size(), CV_32FC1);
  base::parallelFor(view.depth_m.rows, threads, [&](int v) {
    float* signal = signals.ptr<float>(v);
    fillIncidenceCosines(view.normal_camera, camera, v, signal);
    const float* depth_m = view.depth_m.ptr<float>(v);
    const float* reflectivity = view.reflectivity.ptr<float>(v);
    const float* gloss = view.gloss.ptr<float>(v);
    for (int u = 0; u < signals.cols; ++u) {
      const float at = reflectivity[u] * (1.0F - gloss[u]) * signal[u] / (depth_m[u] * depth_m[u]);  // a mirror sends nothing back
      signal[u] = depth_m[u] > 0.0F ? at : 0.0F;
    }
  });
  cv::Mat means;
  cv::blur(signals, means, {kMatchWindow_px, kMatchWindow_px}, {-1, -1}, cv::BORDER_REPLICATE);
  return means;
}

float pow128(float x) {
  for (int i = 0; i < 7; ++i) {
    x *= x;
  }
  return x;
}

/// Takes the disparities away where too little of the pattern comes back, or too much.
void dropUnseen(const IdealView& view, const cv::Mat& signals, const Kinect1Config& config, int v, RowScratch& row) {
  const float* depth_m = view.depth_m.ptr<float>(v);
  const float* signal = signals.ptr<float>(v);
  const float* gloss = view.gloss.ptr<float>(v);
  const auto per_signal = static_cast<float>(1.0 / config.min_signal);
  const auto per_cosine = static_cast<float>(1.0 / config.min_cosine);
  const auto softness = static_cast<float>(config.dropout_softness);
  const auto max_highlight = static_cast<float>(config.max_highlight);
  for (int u = 0; u < view.depth_m.cols; ++u) {
    const auto i = SmoothWindows::index(u);
    const float cosine = row.cosine[i];
    const float depth_sq = depth_m[u] * depth_m[u];
    const float weakest = std::min(signal[u] * per_signal, cosine * per_cosine);
    const bool dazzles = gloss[u] * gloss[u] * pow128(cosine) > max_highlight * depth_sq;
    const float threshold = std::max(1.0F + softness * row.signal[i], 0.0F);
    const bool is_seen = weakest > threshold && !dazzles;
    row.disparity_px[i] = is_seen ? row.disparity_px[i] : 0.0F;
  }
}

/// Noise and quantisation in disparity; what is out of range becomes no reading. Free of branches, to be vectorised.
void measureRow(const Matcher& matcher, const RowScratch& row, int width, float* __restrict depth_m) {
  const float* __restrict ideal_px = row.disparity_px.data();
  const float* __restrict steep = row.steep.data();
  const float* __restrict axial = row.axial.data();
  const auto step_px = static_cast<float>(matcher.config.disparity_step_px);
  const float steps_per_px = 1.0F / step_px;
  const float quantisation_var = step_px * step_px / 12.0F;
  const auto noise_scale = static_cast<float>(matcher.config.noise_scale);
  const auto min_m = static_cast<float>(matcher.config.min_range_m);
  const auto max_m = static_cast<float>(matcher.config.max_range_m);
  for (int u = 0; u < width; ++u) {
    const float z_m = matcher.focal_baseline / ideal_px[u];
    const float sigma_px = (frontalSigma(z_m) + steep[u] / std::sqrt(z_m)) * ideal_px[u] / z_m;
    const float added_var = sigma_px * sigma_px - quantisation_var;
    const float added_px = std::sqrt(added_var > 0.0F ? added_var : 0.0F) * noise_scale;
    const float steps = std::floor((ideal_px[u] + added_px * axial[u]) * steps_per_px + 0.5F);
    const float reading_m = matcher.focal_baseline / (steps * step_px);
    const bool in_range = (reading_m >= min_m) & (reading_m <= max_m);
    depth_m[u] = ((ideal_px[u] > 0.0F) & in_range) ? reading_m : kNoReading;
  }
}

}  // namespace

std::vector<std::string> Kinect1Config::validate() const {
  base::ConfigRules rules;
  rules.between("baseline_m", baseline_m, 0.01, 1.0).between("disparity_step_px", disparity_step_px, 0.01, 1.0);
  rules.between("agreement_px", agreement_px, 0.1, 2.0).between("min_agreement", min_agreement, 0.01, 1.0);
  rules.between("noise_scale", noise_scale, 0.0, 10.0).between("noise_spacing_px", noise_spacing_px, 1, 32);
  rules.greater("min_signal", min_signal, 0.0).between("min_cosine", min_cosine, 0.01, 1.0);
  rules.between("dropout_softness", dropout_softness, 0.0, 1.0)
      .between("dropout_spacing_px", dropout_spacing_px, 1, 64)
      .greater("max_highlight", max_highlight, 0.0);
  rules.between("min_range_m", min_range_m, 0.1, 10.0).greater("max_range_m", max_range_m, min_range_m);
  return rules.messages();
}

double kinect1AxialSigma_m(double z_m, double theta_rad) {
  return static_cast<double>(frontalSigma(static_cast<float>(z_m))) +
         static_cast<double>(steepSigma(static_cast<float>(std::cos(theta_rad)))) / std::sqrt(z_m);
}

double kinect1LateralSigma_px(double theta_rad) {
  return static_cast<double>(lateralSigma(static_cast<float>(std::cos(theta_rad))));
}

cv::Mat senseKinect1(const IdealView& view, const PinholeCamera& camera, const Kinect1Config& config, const SensorRun& run) {
  OIKOS_CHECK(camera.width > kMatchWindow_px && camera.height > kMatchWindow_px);
  const Matcher matcher(camera, config);
  const Noise noise(run, {camera.width, camera.height, config.noise_spacing_px}, config.dropout_spacing_px);
  const cv::Mat signals = gatherSignals(view, camera, run.threads);
  const cv::Mat disparities = lightScene(view, matcher, run.threads);
  cv::Mat depth_m(view.depth_m.size(), CV_32FC1, cv::Scalar(static_cast<double>(kNoReading)));
  const int bands = (camera.height - 2 * kMatchRadius_px + kBandRows - 1) / kBandRows;
  base::parallelFor(bands, run.threads, [&](int band) {
    RowScratch row(camera.width);
    const int first = kMatchRadius_px + band * kBandRows;
    for (int v = first; v < std::min(camera.height - kMatchRadius_px, first + kBandRows); ++v) {
      noise.axial.fillRow(v, row.axial.data());
      noise.across.fillRow(v, row.across.data());
      noise.down.fillRow(v, row.down.data());
      noise.signal.fillRow(v, row.signal.data());
      fillIncidenceCosines(view.normal_camera, camera, v, row.cosine.data());
      std::transform(row.cosine.begin(), row.cosine.end(), row.steep.begin(), steepSigma);
      matchRow(view, matcher, disparities, v, row);
      dropUnseen(view, signals, config, v, row);
      measureRow(matcher, row, camera.width, depth_m.ptr<float>(v));
    }
  });
  return depth_m;
}

}  // namespace oikos::camera
