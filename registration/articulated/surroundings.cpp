// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/base/error.h"

namespace oikos::registration {

namespace {

constexpr float kMaxShift_m = 0.03F;
constexpr float kSettledSigma_m = 0.01F;
constexpr float kLooseSigma_m = 0.02F;
constexpr float kNear_m = 0.06F;  // of a surface's plane: readings that may be of it
constexpr float kMinAlong = 0.1F;
constexpr std::size_t kEnough = 200;  // readings

/// A part of the scene, and the way of its that is seen.
using Surface = std::array<int, 4>;

Surface surfaceAt(const render::View& view, int u, int v) {
  const auto& normal = view.normal_camera.at<cv::Vec3f>(v, u);
  const auto way = [](float along) { return static_cast<int>(std::lround(1.5F * along)); };
  return {view.part.at<int>(v, u), way(normal[0]), way(normal[1]), way(normal[2])};
}

/// How far the ray goes against the normal, for each metre of depth.
float alongAt(const render::View& view, const Scan& scan, int u, int v) {
  const auto& normal = view.normal_camera.at<cv::Vec3f>(v, u);
  const Eigen::Vector3f ray = scan.camera.ray(u, v).cast<float>();
  return -(normal[0] * ray.x() + normal[1] * ray.y() + normal[2] * ray.z());
}

/// Behind the surface, along its normal; nothing: no reading, or none that may be of it.
std::optional<float> behindAt(const render::View& view, const Scan& scan, int u, int v) {
  const float reading_m = scan.at(u, v).point_camera.z();
  const float along = alongAt(view, scan, u, v);
  if (reading_m <= 0.0F || along < kMinAlong) {
    return std::nullopt;
  }
  const float behind_m = along * (reading_m - view.depth_m.at<float>(v, u));
  return std::abs(behind_m) < kNear_m ? std::optional(behind_m) : std::nullopt;
}

/// Of those that enough readings are near to.
std::map<Surface, float> shiftsOf(const render::View& view, const Scan& scan) {
  std::map<Surface, std::vector<float>> behind_m;
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      const std::optional<float> behind = view.part.at<int>(v, u) >= 0 ? behindAt(view, scan, u, v) : std::nullopt;
      if (behind) {
        behind_m[surfaceAt(view, u, v)].push_back(*behind);
      }
    }
  }
  std::map<Surface, float> shifts_m;
  for (auto& [surface, values] : behind_m) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() >= kEnough && std::abs(*middle) <= kMaxShift_m) {
      shifts_m[surface] = *middle;
    }
  }
  return shifts_m;
}

}  // namespace

Surroundings surroundingsOf(const render::View& view, const Scan& scan) {
  OIKOS_CHECK(view.depth_m.size() == cv::Size(scan.camera.width, scan.camera.height) && !view.normal_camera.empty() && !view.part.empty());
  Surroundings settled{view.depth_m.clone(), view.normal_camera, cv::Mat(view.depth_m.size(), CV_32FC1, cv::Scalar(kLooseSigma_m))};
  const std::map<Surface, float> shifts_m = shiftsOf(view, scan);
  for (int v = 0; v < scan.camera.height && !shifts_m.empty(); ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      const auto shift = view.part.at<int>(v, u) >= 0 ? shifts_m.find(surfaceAt(view, u, v)) : shifts_m.end();
      if (shift != shifts_m.end()) {
        settled.depth_m.at<float>(v, u) += shift->second / std::max(kMinAlong, alongAt(view, scan, u, v));
        settled.sigma_m.at<float>(v, u) = kSettledSigma_m;
      }
    }
  }
  return settled;
}

Surroundings cropped(const Surroundings& surroundings, const PixelBox& box) {
  if (surroundings.isEmpty()) {
    return {};
  }
  const cv::Rect part(cv::Point(box.left, box.top), cv::Point(box.right, box.bottom));
  return {surroundings.depth_m(part), surroundings.normal_camera(part), surroundings.sigma_m(part)};
}

Surroundings thinned(const Surroundings& surroundings, int factor) {
  if (surroundings.isEmpty()) {
    return {};
  }
  const cv::Size size((surroundings.depth_m.cols + factor - 1) / factor, (surroundings.depth_m.rows + factor - 1) / factor);
  Surroundings thin{cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC3), cv::Mat(size, CV_32FC1)};
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      thin.depth_m.at<float>(v, u) = surroundings.depth_m.at<float>(factor * v, factor * u);
      thin.normal_camera.at<cv::Vec3f>(v, u) = surroundings.normal_camera.at<cv::Vec3f>(factor * v, factor * u);
      thin.sigma_m.at<float>(v, u) = surroundings.sigma_m.at<float>(factor * v, factor * u);
    }
  }
  return thin;
}

}  // namespace oikos::registration
