// SPDX-License-Identifier: Apache-2.0
#include "core/camera/sensor/shutter_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/error.h"

namespace oikos::camera {

namespace {

constexpr float kUnseenFlow_px = 0.1F;
constexpr float kSampleSpacing_px = 1.5F;  // a bilinear sample is two pixels wide

/// Light as four floats a pixel, and where bilinear interpolation may begin.
class LightSampler {
 public:
  explicit LightSampler(const cv::Mat& light)
      : pixels_(light.ptr<float>()),
        stride_(static_cast<std::ptrdiff_t>(light.step1())),
        last_u_(static_cast<float>(light.cols - 1) - kMargin),
        last_v_(static_cast<float>(light.rows - 1) - kMargin) {}

  /// Beyond the border the border's pixels go on. NaN: the first pixel.
  [[nodiscard]] float clampU(float u) const { return clamp(u, last_u_); }
  [[nodiscard]] float clampV(float v) const { return clamp(v, last_v_); }

  /// Bilinear, at a place inside the image.
  [[nodiscard]] Eigen::Array4f sample(float u, float v) const {
    const int column = static_cast<int>(u);
    const int row = static_cast<int>(v);
    const float right = u - static_cast<float>(column);
    const float below = v - static_cast<float>(row);
    using PixelPair = Eigen::Array<float, 8, 1>;
    const float* at = pixels_ + row * stride_ + 4 * column;
    const Eigen::Map<const PixelPair> upper(at);
    const Eigen::Map<const PixelPair> lower(at + stride_);
    const PixelPair both = upper + below * (lower - upper);
    return both.head<4>() + right * (both.tail<4>() - both.head<4>());
  }

 private:
  static constexpr float kMargin = 1e-3F;  // so that the pixel to the right and below is inside too
  static float clamp(float x, float last) { return x > 0.0F ? (x < last ? x : last) : 0.0F; }

  const float* pixels_;
  std::ptrdiff_t stride_;
  float last_u_;
  float last_v_;
};

/// A pixel's flow during the exposure lies between two places in the ideal image.
struct FlowRow {
  explicit FlowRow(int width) : begin_u(static_cast<std::size_t>(width)), begin_v(begin_u), end_u(begin_u), end_v(begin_u) {}
  std::vector<float> begin_u, begin_v, end_u, end_v;
};

/// The samples of a flow lie in the middle of equal parts of it, spread a little, so that their deviation is that of the whole flow.
struct SampleSpread {
  explicit SampleSpread(int count)
      : part(1.0F / static_cast<float>(count)), step(count > 1 ? part / std::sqrt(1.0F - part * part) : 0.0F) {}
  float part;
  float step;  ///< share of the flow from one sample to the next
};

std::vector<SampleSpread> makeSpreads(int max_samples) {
  std::vector<SampleSpread> spreads;
  for (int count = 1; count <= max_samples; ++count) {
    spreads.emplace_back(count);
  }
  return spreads;
}

/// The mean over the flow's samples.
Eigen::Array4f sampleFlow(const LightSampler& light, const FlowRow& flow, std::size_t i, const std::vector<SampleSpread>& spreads) {
  const float begin_u = light.clampU(flow.begin_u[i]);
  const float begin_v = light.clampV(flow.begin_v[i]);
  const float across = light.clampU(flow.end_u[i]) - begin_u;
  const float down = light.clampV(flow.end_v[i]) - begin_v;
  const float length_px = std::max(std::abs(across), std::abs(down));
  const int wanted = length_px < kUnseenFlow_px ? 1 : std::max(2, 1 + static_cast<int>(length_px / kSampleSpacing_px));
  const int count = std::min(static_cast<int>(spreads.size()), wanted);
  const SampleSpread& spread = spreads[static_cast<std::size_t>(count - 1)];
  const float first = 0.5F - 0.5F * spread.step * static_cast<float>(count - 1);
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int k = 0; k < count; ++k) {
    const float share = first + spread.step * static_cast<float>(k);
    sum += light.sample(begin_u + share * across, begin_v + share * down);
  }
  return sum * spread.part;
}

}  // namespace

ShutterMotion makeSteadyMotion(const geometry::Vector6d& twist_camera, double readout_s, int rows) {
  ShutterMotion motion;
  motion.twist_camera = twist_camera;
  for (int v = 0; v < rows && readout_s > 0.0; ++v) {
    const double since_mid_s = rows > 1 ? readout_s * (static_cast<double>(v) / (rows - 1) - 0.5) : 0.0;
    motion.T_mid_row.push_back(geometry::expSe3(twist_camera * since_mid_s));
  }
  return motion;
}

ShutterWarp::RowProjection::RowProjection(const PinholeCamera& camera, const Eigen::Isometry3d& T_mid_camera, int v) {
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  const Eigen::Matrix3d homography = K * T_mid_camera.linear();
  per_column = (homography.col(0) / camera.fx).cast<float>();
  start = (homography * camera.ray(0.0, v)).cast<float>();
  per_inverse_depth = (K * T_mid_camera.translation()).cast<float>();
}

void ShutterWarp::RowProjection::fill(const float* __restrict depths_m, int width, float* __restrict pixels_u,
                                      float* __restrict pixels_v) const {
  const Eigen::Vector3f column = per_column;
  const Eigen::Vector3f first = start;
  const Eigen::Vector3f moved = per_inverse_depth;
  for (int u = 0; u < width; ++u) {
    const float inverse_depth = depths_m[u] > 0.0F ? 1.0F / depths_m[u] : 0.0F;
    const auto at = static_cast<float>(u);
    const float z = at * column[2] + first[2] + inverse_depth * moved[2];
    const float per_z = 1.0F / (z > 1e-6F ? z : 1e-6F);
    pixels_u[u] = (at * column[0] + first[0] + inverse_depth * moved[0]) * per_z;
    pixels_v[u] = (at * column[1] + first[1] + inverse_depth * moved[1]) * per_z;
  }
}

ShutterWarp::ShutterWarp(const PinholeCamera& camera, const ShutterMotion& motion, const Settings& settings)
    : camera_(camera),
      motion_(motion),
      T_middle_begin_(geometry::expSe3(motion.twist_camera * (-0.5 * settings.exposure_s))),
      T_middle_end_(geometry::expSe3(motion.twist_camera * (0.5 * settings.exposure_s))),
      max_samples_(settings.max_samples) {
  OIKOS_CHECK(camera.width >= 2 && camera.height >= 2 && settings.max_samples > 0);
  OIKOS_CHECK(motion.T_mid_row.empty() || static_cast<int>(motion.T_mid_row.size()) == camera.height);
}

void ShutterWarp::fillRow(const cv::Mat& light, const cv::Mat& depth_m, int v, float* row) const {
  const Eigen::Isometry3d T_mid_row =
      motion_.T_mid_row.empty() ? Eigen::Isometry3d::Identity() : motion_.T_mid_row[static_cast<std::size_t>(v)];
  const float* depths_m = depth_m.ptr<float>(v);
  FlowRow flow(camera_.width);
  RowProjection(camera_, T_mid_row * T_middle_begin_, v).fill(depths_m, camera_.width, flow.begin_u.data(), flow.begin_v.data());
  RowProjection(camera_, T_mid_row * T_middle_end_, v).fill(depths_m, camera_.width, flow.end_u.data(), flow.end_v.data());
  const LightSampler sampler(light);
  const std::vector<SampleSpread> spreads = makeSpreads(max_samples_);
  for (int u = 0; u < camera_.width; ++u) {
    Eigen::Map<Eigen::Array4f>(row + 4 * u) = sampleFlow(sampler, flow, static_cast<std::size_t>(u), spreads);
  }
}

}  // namespace oikos::camera
