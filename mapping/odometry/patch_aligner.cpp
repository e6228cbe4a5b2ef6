// SPDX-License-Identifier: Apache-2.0
// Inverse compositional alignment (Baker & Matthews, "Lucas-Kanade 20 Years On", IJCV 2004) of a pre-warped patch, with gain and
// bias as in SVO (Forster et al., ICRA 2014). Residual per pixel x of the patch, at the current translation d:
//   e(x) = I_target(p + x + d) - (gain * I_host(W x) + bias)
#include "mapping/odometry/patch_aligner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace oikos::mapping {

namespace {

constexpr int kRadius = 5;
constexpr int kSide = 2 * kRadius + 1;
constexpr int kPixels = kSide * kSide;
constexpr int kBorderedSide = kSide + 2;

/// Bilinear sample of a window of `Side` x `Side` pixels, step one, whose first pixel is at (x, y); false if it leaves the image.
template <int Side>
bool sampleWindow(const cv::Mat& image, double x, double y, float* out) {
  if (!(x >= 0.0 && y >= 0.0 && x + Side < image.cols && y + Side < image.rows)) {
    return false;
  }
  const int ix = static_cast<int>(x);
  const int iy = static_cast<int>(y);
  const auto fx = static_cast<float>(x - ix);
  const auto fy = static_cast<float>(y - iy);
  const float w00 = (1.0F - fx) * (1.0F - fy);
  const float w01 = fx * (1.0F - fy);
  const float w10 = (1.0F - fx) * fy;
  const float w11 = fx * fy;
  for (int r = 0; r < Side; ++r) {
    const auto* top = image.ptr<unsigned char>(iy + r) + ix;
    const auto* bottom = image.ptr<unsigned char>(iy + r + 1) + ix;
    for (int c = 0; c < Side; ++c) {
      out[r * Side + c] = w00 * static_cast<float>(top[c]) + w01 * static_cast<float>(top[c + 1]) + w10 * static_cast<float>(bottom[c]) +
                          w11 * static_cast<float>(bottom[c + 1]);
    }
  }
  return true;
}

float sampleBilinear(const cv::Mat& image, float x, float y) {
  const int ix = static_cast<int>(x);
  const int iy = static_cast<int>(y);
  const float fx = x - static_cast<float>(ix);
  const float fy = y - static_cast<float>(iy);
  const auto* top = image.ptr<unsigned char>(iy) + ix;
  const auto* bottom = image.ptr<unsigned char>(iy + 1) + ix;
  return (1.0F - fy) * ((1.0F - fx) * static_cast<float>(top[0]) + fx * static_cast<float>(top[1])) +
         fy * ((1.0F - fx) * static_cast<float>(bottom[0]) + fx * static_cast<float>(bottom[1]));
}

double toLevel(double px, int level) {
  return (px + 0.5) / (1 << level) - 0.5;
}
double fromLevel(double px, int level) {
  return (px + 0.5) * (1 << level) - 0.5;
}

/// The host's patch as it should look on the target's pixel grid at one level, with its gradients and normal matrix.
struct Template {
  std::array<float, kPixels> value;
  std::array<float, kPixels> gradient_x;
  std::array<float, kPixels> gradient_y;
  Eigen::Matrix4f inverse_normal;  ///< of the parameters (x, y, gain, bias)
  float mean = 0.0F;
  float deviation = 0.0F;  ///< root of the sum of squares about the mean
};

bool warpPatch(const ImagePyramid& host, const PatchQuery& query, int level, std::array<float, kBorderedSide * kBorderedSide>& patch) {
  const Eigen::Matrix2d host_from_target = query.target_from_host.inverse() * static_cast<double>(1 << level);
  const double scale = std::sqrt(std::abs(host_from_target.determinant()));
  int host_level = 0;
  while (host_level + 1 < host.levels() && scale > 1.5 * (1 << host_level)) {
    ++host_level;
  }
  const cv::Mat& image = host.level(host_level);
  const Eigen::Matrix2f step = (host_from_target / (1 << host_level)).cast<float>();
  const Eigen::Vector2f centre(static_cast<float>(toLevel(query.host_px.x(), host_level)),
                               static_cast<float>(toLevel(query.host_px.y(), host_level)));
  const float reach_x = (std::abs(step(0, 0)) + std::abs(step(0, 1))) * (kRadius + 1);
  const float reach_y = (std::abs(step(1, 0)) + std::abs(step(1, 1))) * (kRadius + 1);
  if (!(centre.x() - reach_x >= 0.0F && centre.y() - reach_y >= 0.0F && centre.x() + reach_x < static_cast<float>(image.cols - 1) &&
        centre.y() + reach_y < static_cast<float>(image.rows - 1))) {
    return false;
  }
  float* out = patch.data();
  for (int y = -kRadius - 1; y <= kRadius + 1; ++y) {
    Eigen::Vector2f p = centre + step * Eigen::Vector2f(-kRadius - 1, static_cast<float>(y));
    for (int x = -kRadius - 1; x <= kRadius + 1; ++x, p += step.col(0)) {
      *out++ = sampleBilinear(image, p.x(), p.y());
    }
  }
  return true;
}

/// False where the patch is too plain to be located.
bool prepare(const std::array<float, kBorderedSide * kBorderedSide>& patch, double min_eigenvalue, Template& t) {
  Eigen::Matrix4f normal = Eigen::Matrix4f::Zero();
  float sum = 0.0F;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float* centre = &patch[(y + 1) * kBorderedSide + x + 1];
      const int i = y * kSide + x;
      t.value[i] = centre[0];
      t.gradient_x[i] = 0.5F * (centre[1] - centre[-1]);
      t.gradient_y[i] = 0.5F * (centre[kBorderedSide] - centre[-kBorderedSide]);
      sum += centre[0];
    }
  }
  t.mean = sum / kPixels;
  for (int i = 0; i < kPixels; ++i) {
    t.value[i] -= t.mean;
    const Eigen::Vector4f j(t.gradient_x[i], t.gradient_y[i], t.value[i], 1.0F);
    normal.noalias() += j * j.transpose();
  }
  t.deviation = std::sqrt(normal(2, 2));
  const float trace = 0.5F * (normal(0, 0) + normal(1, 1));
  const float difference = 0.5F * (normal(0, 0) - normal(1, 1));
  const float least = trace - std::sqrt(difference * difference + normal(0, 1) * normal(0, 1));
  if (!(least > static_cast<float>(min_eigenvalue) * kPixels)) {
    return false;
  }
  t.inverse_normal = normal.inverse();
  return t.inverse_normal.allFinite();
}

enum class LevelStatus { kConverged, kDiverged };

LevelStatus alignLevel(const Template& t, const cv::Mat& image, const PatchAlignerConfig& config, Eigen::Vector2d& position,
                       double& correlation) {
  float gain = 1.0F;
  float bias = t.mean;
  const Eigen::Vector2d start = position;
  std::array<float, kPixels> window;
  for (int iteration = 0; iteration < config.max_iterations; ++iteration) {
    if (!sampleWindow<kSide>(image, position.x() - kRadius, position.y() - kRadius, window.data())) {
      return LevelStatus::kDiverged;
    }
    Eigen::Vector4f gradient = Eigen::Vector4f::Zero();
    for (int i = 0; i < kPixels; ++i) {
      const float e = window[i] - gain * t.value[i] - bias;
      gradient[0] += t.gradient_x[i] * e;
      gradient[1] += t.gradient_y[i] * e;
      gradient[2] += t.value[i] * e;
      gradient[3] += e;
    }
    const Eigen::Vector4f step = t.inverse_normal * gradient;
    gain += step[2];
    bias += step[3];
    // The inverse composition divides by the gain: the gradient of what is seen is the template's, times the gain.
    const Eigen::Vector2d move = step.head<2>().cast<double>() / std::clamp(static_cast<double>(gain), 0.3, 3.0);
    position -= move;
    if (!position.allFinite() || move.norm() > config.max_step_px * 2.0 || (position - start).norm() > config.max_step_px * 2.0) {
      return LevelStatus::kDiverged;
    }
    if (move.norm() < config.converged_px) {
      break;
    }
  }
  if (!sampleWindow<kSide>(image, position.x() - kRadius, position.y() - kRadius, window.data())) {
    return LevelStatus::kDiverged;
  }
  float sum = 0.0F;
  float squares = 0.0F;
  float cross = 0.0F;
  for (int i = 0; i < kPixels; ++i) {
    sum += window[i];
    squares += window[i] * window[i];
    cross += window[i] * t.value[i];
  }
  const float deviation = std::sqrt(std::max(squares - sum * sum / kPixels, 1e-6F));
  correlation = static_cast<double>(cross / (deviation * std::max(t.deviation, 1e-3F)));
  return LevelStatus::kConverged;
}

}  // namespace

PatchMatch alignPatch(const ImagePyramid& host, const ImagePyramid& target, const PatchQuery& query, const PatchAlignerConfig& config) {
  PatchMatch match;
  match.target_px = query.start_px;
  std::array<float, kBorderedSide * kBorderedSide> patch;
  Template t;
  for (int level = std::min(query.coarsest_level, target.levels() - 1); level >= 0; --level) {
    if (!warpPatch(host, query, level, patch) || !prepare(patch, config.min_eigenvalue, t)) {
      continue;  // a coarse level may leave the image, or be plain: the finer ones decide
    }
    Eigen::Vector2d position(toLevel(match.target_px.x(), level), toLevel(match.target_px.y(), level));
    double correlation = 0.0;
    if (alignLevel(t, target.level(level), config, position, correlation) == LevelStatus::kDiverged) {
      continue;
    }
    const bool agrees = correlation >= config.min_correlation;
    if (match.found && !agrees) {
      continue;
    }
    match.target_px = {fromLevel(position.x(), level), fromLevel(position.y(), level)};
    if (agrees && level <= config.coarsest_answer) {
      match.found = true;
      match.correlation = correlation;
      match.level = level;
    }
  }
  return match;
}

}  // namespace oikos::mapping
