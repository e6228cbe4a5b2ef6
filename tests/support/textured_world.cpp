// SPDX-License-Identifier: Apache-2.0
#include "tests/support/textured_world.h"

#include <cmath>
#include <opencv2/core.hpp>

namespace oikos::test {

namespace {

constexpr std::array<double, 4> kCells_m = {0.34, 0.17, 0.085, 0.045};
constexpr std::array<double, 4> kAmplitudes = {0.5, 0.6, 0.7, 0.6};

std::uint64_t mix(std::uint64_t x) {  // splitmix64
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

/// A number from -1 to 1 for each corner of the lattice.
double corner(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  const auto key = static_cast<std::uint64_t>(x) * 0x8DA6B343ULL ^ static_cast<std::uint64_t>(y) * 0xD8163841ULL << 7 ^
                   static_cast<std::uint64_t>(z) * 0xCB1AB31FULL << 13;
  return static_cast<double>(mix(key ^ seed) >> 11) * 0x1.0p-52 - 1.0;
}

/// Quintic blend (Perlin 2002, "Improving Noise"): two continuous derivatives across cells.
double blend(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

double between(double a, double b, double t) {
  return a + (b - a) * t;
}

double latticeNoise(const Eigen::Vector3d& p, std::uint64_t seed) {
  const Eigen::Vector3d low = p.array().floor();
  const auto x = static_cast<std::int64_t>(low.x());
  const auto y = static_cast<std::int64_t>(low.y());
  const auto z = static_cast<std::int64_t>(low.z());
  const double u = blend(p.x() - low.x());
  const double v = blend(p.y() - low.y());
  const double w = blend(p.z() - low.z());
  const auto slice = [&](std::int64_t k) {
    return between(between(corner(x, y, k, seed), corner(x + 1, y, k, seed), u),
                   between(corner(x, y + 1, k, seed), corner(x + 1, y + 1, k, seed), u), v);
  };
  return between(slice(z), slice(z + 1), w);
}

/// The hue of a surface with its brightness taken out, so that the grey image does not depend on it.
cv::Vec3d tint(const std::array<unsigned char, 3>& rgb) {
  const double brightness = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
  const auto soften = [&](unsigned char value) { return 0.5 + 0.5 * value / brightness; };
  return {soften(rgb[2]), soften(rgb[1]), soften(rgb[0])};
}

}  // namespace

TexturedWorld::TexturedWorld(AnalyticRoom room, std::uint64_t seed) : room_(std::move(room)) {
  for (std::size_t i = 0; i < octaves_.size(); ++i) {
    const std::uint64_t own = mix(seed * 16 + i);
    // Each lattice is turned another way: no surface lies along its cells and no two octaves repeat together.
    const Eigen::AngleAxisd turn(0.7 + 1.1 * static_cast<double>(i), Eigen::Vector3d(1.0, 2.0 - static_cast<double>(i), 0.5).normalized());
    octaves_[i] = {turn.toRotationMatrix() / kCells_m[i],
                   100.0 * Eigen::Vector3d(corner(1, 0, 0, own), corner(0, 1, 0, own), corner(0, 0, 1, own)), kAmplitudes[i], own};
  }
}

TexturedWorld TexturedWorld::repeating(AnalyticRoom room, double period_m, std::uint64_t seed) {
  TexturedWorld world(std::move(room), seed);
  world.period_m_ = period_m;
  return world;
}

double TexturedWorld::grayAt(const Eigen::Vector3d& point_map) const {
  Eigen::Vector3d point = point_map;
  if (period_m_ > 0.0) {
    point.x() -= period_m_ * std::floor(point.x() / period_m_);
  }
  double sum = 0.0;
  for (const Octave& octave : octaves_) {
    sum += octave.amplitude * latticeNoise(octave.per_m * point + octave.offset, octave.seed);
  }
  return 128.0 + 110.0 * std::tanh(1.5 * sum);
}

camera::RgbdFrame TexturedWorld::render(const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera,
                                        recording::Channels channels) const {
  return renderRows(
      camera, [&](int) { return T_map_camera; }, channels);
}

camera::RgbdFrame TexturedWorld::renderRows(const camera::PinholeCamera& camera, const std::function<Eigen::Isometry3d(int)>& T_map_camera,
                                            recording::Channels channels) const {
  camera::RgbdFrame frame;
  frame.gray.create(camera.height, camera.width, CV_8UC1);
  frame.depth_m.create(camera.height, camera.width, CV_32FC1);
  if (channels == recording::Channels::kColor) {
    frame.color.create(camera.height, camera.width, CV_8UC3);
  }
  for (int v = 0; v < camera.height; ++v) {
    const Eigen::Isometry3d T = T_map_camera(v);
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d direction_map = T.linear() * camera.ray(u, v);
      const AnalyticRoom::Hit hit = room_.castRay(T.translation(), direction_map);
      const double gray = grayAt(T.translation() + hit.distance_m * direction_map);
      frame.depth_m.at<float>(v, u) = static_cast<float>(hit.distance_m);
      frame.gray.at<unsigned char>(v, u) = cv::saturate_cast<unsigned char>(gray);
      if (!frame.color.empty()) {
        const cv::Vec3d bgr = gray * tint(hit.rgb);
        frame.color.at<cv::Vec3b>(v, u) = {cv::saturate_cast<unsigned char>(bgr[0]), cv::saturate_cast<unsigned char>(bgr[1]),
                                           cv::saturate_cast<unsigned char>(bgr[2])};
      }
    }
  }
  return frame;
}

camera::PinholeCamera texturedCamera() {
  return {320, 240, 266.0, 266.0, 159.5, 119.5};
}

}  // namespace oikos::test
