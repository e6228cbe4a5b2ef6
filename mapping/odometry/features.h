// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"

namespace oikos::mapping {

enum class FeatureType { kSift, kOrb };
constexpr auto enumTable(FeatureType) {
  return std::to_array<base::EnumName<FeatureType>>({{FeatureType::kSift, "sift"}, {FeatureType::kOrb, "orb"}});
}

struct FeatureConfig {
  FeatureType type = FeatureType::kSift;
  int count = 500;                   ///< kept per image, spread evenly (S350)
  double image_scale = 0.5;          ///< SIFT runs on the image at this scale: a quarter of the time, and coarse places suffice
  double contrast_threshold = 0.02;  ///< SIFT's, of OpenCV
  int fast_threshold = 12;           ///< ORB's
  double max_depth_m = 8.0;          ///< features without a reading up to here are dropped

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("type", type);
    visitor("count", count);
    visitor("image_scale", image_scale);
    visitor("contrast_threshold", contrast_threshold);
    visitor("fast_threshold", fast_threshold);
    visitor("max_depth_m", max_depth_m);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// 256 bits. ORB's own (Rublee et al., ICCV 2011), or SIFT's 128 numbers as two bits each (after Zhou et al., "Scalar
/// Quantization for Large Scale Image Search", ACM MM 2012): compared by Hamming distance.
using Descriptor = std::array<std::uint64_t, 4>;

[[nodiscard]] int hammingDistance(const Descriptor& a, const Descriptor& b);

/// Features of one image, each lifted to 3D by its depth (S39). All vectors have one entry a feature.
struct Features {
  std::vector<Eigen::Vector2d> pixel;
  std::vector<Eigen::Vector3d> point_camera;  ///< metres
  std::vector<Descriptor> descriptor;

  [[nodiscard]] int size() const { return static_cast<int>(pixel.size()); }
};

[[nodiscard]] Features extractFeatures(const camera::RgbdFrame& frame, const camera::PinholeCamera& camera, const FeatureConfig& config);

struct FeatureMatch {
  int a = -1;
  int b = -1;
  int distance = 0;
};

/// Mutual nearest neighbours by Hamming distance that pass Lowe's ratio test; ordered by `a`.
[[nodiscard]] std::vector<FeatureMatch> matchFeatures(const Features& a, const Features& b, int max_distance = 80, double max_ratio = 0.9);

}  // namespace oikos::mapping
