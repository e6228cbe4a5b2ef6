// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/features.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace oikos::mapping {

namespace {

/// Keeps the strongest `count` keypoints with an equal share for each cell of an 8 x 6 grid, what cells leave over going to the
/// strongest of the rest.
std::vector<cv::KeyPoint> spreadEvenly(std::vector<cv::KeyPoint> keypoints, const cv::Size& size, int count) {
  constexpr int kColumns = 8;
  constexpr int kRows = 6;
  std::stable_sort(keypoints.begin(), keypoints.end(),
                   [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
  std::array<int, kColumns * kRows> held{};
  const int share = std::max(1, count / (kColumns * kRows));
  std::vector<cv::KeyPoint> kept;
  std::vector<cv::KeyPoint> rest;
  for (const cv::KeyPoint& k : keypoints) {
    const int column = std::clamp(static_cast<int>(k.pt.x) * kColumns / size.width, 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(k.pt.y) * kRows / size.height, 0, kRows - 1);
    (held[static_cast<std::size_t>(row * kColumns + column)]++ < share ? kept : rest).push_back(k);
  }
  const int room = std::max(0, count - static_cast<int>(kept.size()));
  kept.insert(kept.end(), rest.begin(), rest.begin() + std::min<std::ptrdiff_t>(room, static_cast<std::ptrdiff_t>(rest.size())));
  return kept;
}

/// Two bits a number: above the lower quartile-ish and above the upper threshold of this descriptor's own values.
Descriptor quantise(const float* sift) {
  std::array<float, 128> sorted;
  std::copy(sift, sift + 128, sorted.begin());
  std::nth_element(sorted.begin(), sorted.begin() + 64, sorted.end());
  const float median = sorted[64];
  std::nth_element(sorted.begin() + 64, sorted.begin() + 96, sorted.end());
  const float upper = sorted[96];
  Descriptor d{};
  for (std::size_t i = 0; i < 128; ++i) {
    d[i / 64] |= static_cast<std::uint64_t>(sift[i] > median) << (i % 64);
    d[2 + i / 64] |= static_cast<std::uint64_t>(sift[i] > upper) << (i % 64);
  }
  return d;
}

struct Described {
  std::vector<cv::KeyPoint> keypoints;
  std::vector<Descriptor> descriptors;
};

Described describeSift(const cv::Mat& gray, const FeatureConfig& config) {
  cv::Mat small = gray;
  if (config.image_scale < 1.0) {
    cv::resize(gray, small, cv::Size(), config.image_scale, config.image_scale, cv::INTER_AREA);
  }
  const auto sift = cv::SIFT::create(0, 3, config.contrast_threshold, 10.0, 1.6);
  Described described;
  sift->detect(small, described.keypoints);
  described.keypoints = spreadEvenly(std::move(described.keypoints), small.size(), config.count);
  cv::Mat values;
  sift->compute(small, described.keypoints, values);
  for (int i = 0; i < values.rows; ++i) {
    described.descriptors.push_back(quantise(values.ptr<float>(i)));
  }
  const auto scale_x = static_cast<float>(gray.cols) / static_cast<float>(small.cols);
  const auto scale_y = static_cast<float>(gray.rows) / static_cast<float>(small.rows);
  for (cv::KeyPoint& k : described.keypoints) {
    k.pt = {(k.pt.x + 0.5F) * scale_x - 0.5F, (k.pt.y + 0.5F) * scale_y - 0.5F};
  }
  return described;
}

Described describeOrb(const cv::Mat& gray, const FeatureConfig& config) {
  const auto orb = cv::ORB::create(4 * config.count, 1.2F, 8, 19, 0, 2, cv::ORB::HARRIS_SCORE, 31, config.fast_threshold);
  Described described;
  orb->detect(gray, described.keypoints);
  described.keypoints = spreadEvenly(std::move(described.keypoints), gray.size(), config.count);
  cv::Mat values;
  orb->compute(gray, described.keypoints, values);
  for (int i = 0; i < values.rows; ++i) {
    Descriptor d;
    std::memcpy(d.data(), values.ptr(i), sizeof(d));
    described.descriptors.push_back(d);
  }
  return described;
}

/// Median of the readings about a pixel, if most of them are there and agree; else 0.
double depthNear(const cv::Mat& depth_m, int x, int y) {
  std::array<float, 25> readings;
  std::size_t n = 0;
  for (int v = std::max(0, y - 2); v <= std::min(depth_m.rows - 1, y + 2); ++v) {
    for (int u = std::max(0, x - 2); u <= std::min(depth_m.cols - 1, x + 2); ++u) {
      if (const float z = depth_m.at<float>(v, u); z > 0.0F) {
        readings[n++] = z;
      }
    }
  }
  if (n < 10) {
    return 0.0;
  }
  std::sort(readings.begin(), readings.begin() + static_cast<std::ptrdiff_t>(n));
  const float median = readings[n / 2];
  return readings[3 * n / 4] - readings[n / 4] < 0.05F * median ? static_cast<double>(median) : 0.0;
}

struct NearestTwo {
  int index = -1;
  int best = 257;
  int second = 257;
};

NearestTwo nearestTwo(const Descriptor& d, const std::vector<Descriptor>& others) {
  NearestTwo n;
  for (std::size_t j = 0; j < others.size(); ++j) {
    const int distance = hammingDistance(d, others[j]);
    if (distance < n.best) {
      n.second = n.best;
      n.best = distance;
      n.index = static_cast<int>(j);
    } else if (distance < n.second) {
      n.second = distance;
    }
  }
  return n;
}

}  // namespace

int hammingDistance(const Descriptor& a, const Descriptor& b) {
  return std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]) + std::popcount(a[2] ^ b[2]) + std::popcount(a[3] ^ b[3]);
}

Features extractFeatures(const camera::RgbdFrame& frame, const camera::PinholeCamera& camera, const FeatureConfig& config) {
  const Described described = config.type == FeatureType::kSift ? describeSift(frame.gray, config) : describeOrb(frame.gray, config);
  Features features;
  for (std::size_t i = 0; i < described.keypoints.size(); ++i) {
    const cv::Point2f p = described.keypoints[i].pt;
    const double depth_m = depthNear(frame.depth_m, static_cast<int>(p.x + 0.5F), static_cast<int>(p.y + 0.5F));
    if (depth_m > 0.0 && depth_m < config.max_depth_m) {
      features.pixel.emplace_back(p.x, p.y);
      features.point_camera.push_back(depth_m * camera.ray(p.x, p.y));
      features.descriptor.push_back(described.descriptors[i]);
    }
  }
  return features;
}

std::vector<FeatureMatch> matchFeatures(const Features& a, const Features& b, int max_distance, double max_ratio) {
  std::vector<NearestTwo> from_b;
  from_b.reserve(b.descriptor.size());
  for (const Descriptor& d : b.descriptor) {
    from_b.push_back(nearestTwo(d, a.descriptor));
  }
  std::vector<FeatureMatch> matches;
  for (std::size_t i = 0; i < a.descriptor.size(); ++i) {
    const NearestTwo n = nearestTwo(a.descriptor[i], b.descriptor);
    const bool mutual = n.index >= 0 && from_b[static_cast<std::size_t>(n.index)].index == static_cast<int>(i);
    if (mutual && n.best <= max_distance && n.best < max_ratio * n.second) {
      matches.push_back({static_cast<int>(i), n.index, n.best});
    }
  }
  return matches;
}

}  // namespace oikos::mapping
