// SPDX-License-Identifier: Apache-2.0
#include "core/recording/inspect/floor_view.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace oikos::recording {

namespace {

struct Plane {
  Eigen::Vector3d normal_camera = Eigen::Vector3d::Zero();  ///< towards the camera
  double distance_m = 0.0;                                  ///< of the camera from the plane
  std::vector<std::size_t> inliers;
};

constexpr int kGrid_px = 10;
constexpr int kTrials = 80;
constexpr int kPlanes = 5;
constexpr double kLeastShare = 0.06;  // of the points
const Eigen::Vector3d kImageUp(0.0, -1.0, 0.0);

std::vector<Eigen::Vector3d> liftGrid(const cv::Mat& depth_m, const camera::PinholeCamera& camera) {
  constexpr float kFarthest_m = 5.0F;
  std::vector<Eigen::Vector3d> points;
  for (int v = kGrid_px / 2; v < depth_m.rows; v += kGrid_px) {
    for (int u = kGrid_px / 2; u < depth_m.cols; u += kGrid_px) {
      const float depth = depth_m.at<float>(v, u);
      if (depth > 0.0F && depth < kFarthest_m) {
        points.push_back(camera.ray(u, v) * depth);
      }
    }
  }
  return points;
}

/// Depth noise of structured light and stereo grows with the square of the distance.
double tolerance(const Eigen::Vector3d& point) {
  return 0.01 + 0.004 * point.z() * point.z();
}

Plane withInliers(const Eigen::Vector3d& normal, double distance_m, const std::vector<Eigen::Vector3d>& points) {
  Plane plane{normal, distance_m, {}};
  if (plane.distance_m < 0.0) {
    plane.normal_camera = -plane.normal_camera;
    plane.distance_m = -plane.distance_m;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(plane.normal_camera.dot(points[i]) + plane.distance_m) < tolerance(points[i])) {
      plane.inliers.push_back(i);
    }
  }
  return plane;
}

Plane refit(const Plane& plane, const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::size_t i : plane.inliers) {
    mean += points[i] / static_cast<double>(plane.inliers.size());
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const std::size_t i : plane.inliers) {
    scatter += (points[i] - mean) * (points[i] - mean).transpose();
  }
  const Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  return withInliers(normal, -normal.dot(mean), points);
}

Plane findLargestPlane(const std::vector<Eigen::Vector3d>& points, std::mt19937& random) {
  Plane best;
  const auto draw = [&] { return points[random() % points.size()]; };
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d a = draw();
    const Eigen::Vector3d cross = (draw() - a).cross(draw() - a);
    if (cross.norm() < 1e-3) {
      continue;
    }
    Plane plane = withInliers(cross.normalized(), -cross.normalized().dot(a), points);
    if (plane.inliers.size() > best.inliers.size()) {
      best = std::move(plane);
    }
  }
  return best.inliers.size() < 3 ? best : refit(best, points);
}

void removeInliers(const Plane& plane, std::vector<Eigen::Vector3d>& points) {
  for (auto i = plane.inliers.rbegin(); i != plane.inliers.rend(); ++i) {
    points[*i] = points.back();
    points.pop_back();
  }
}

bool canBeFloor(const Plane& plane) {
  constexpr double kLeastHeight_m = 0.1;
  constexpr double kLargestTiltCosine = 0.5;  // the camera looks down or up by 60 degrees at most, roll included
  return plane.normal_camera.dot(kImageUp) > kLargestTiltCosine && plane.distance_m > kLeastHeight_m;
}

template <typename Member>
double median(const std::vector<FloorView>& views, Member member) {
  std::vector<double> values;
  for (const FloorView& view : views) {
    values.push_back(view.*member);
  }
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::optional<FloorView> findLowestPlane(const cv::Mat& depth_m, const camera::PinholeCamera& camera, unsigned seed) {
  constexpr std::size_t kFewestPoints = 100;
  std::vector<Eigen::Vector3d> points = liftGrid(depth_m, camera);
  const auto least = static_cast<std::size_t>(kLeastShare * static_cast<double>(points.size()));
  std::mt19937 random(seed);
  std::optional<FloorView> lowest;
  for (int i = 0; i < kPlanes && points.size() >= kFewestPoints; ++i) {
    const Plane plane = findLargestPlane(points, random);
    if (plane.inliers.size() < std::max<std::size_t>(least, 3)) {
      break;
    }
    if (canBeFloor(plane) && (!lowest || plane.distance_m > lowest->camera_height_m)) {
      // the optical axis is (0, 0, 1): its part along the normal is the sine of its elevation
      lowest = {plane.distance_m, std::asin(std::clamp(plane.normal_camera.z(), -1.0, 1.0))};
    }
    removeInliers(plane, points);
  }
  return lowest;
}

std::optional<SharedFloor> agreeOnFloor(std::vector<FloorView> views) {
  constexpr std::size_t kFewestFrames = 3;
  constexpr double kSpread = 0.12;  // of the height: hands move, robots less
  std::sort(views.begin(), views.end(), [](const FloorView& a, const FloorView& b) { return a.camera_height_m > b.camera_height_m; });
  const std::size_t needed = std::max(kFewestFrames, views.size() / 6);
  for (std::size_t first = 0; first + needed <= views.size(); ++first) {
    const double lowest_m = views[first].camera_height_m * (1.0 - 2.0 * kSpread);
    std::size_t last = first;
    while (last < views.size() && views[last].camera_height_m >= lowest_m) {
      ++last;
    }
    if (last - first >= needed) {
      const std::vector<FloorView> shared(views.begin() + static_cast<std::ptrdiff_t>(first),
                                          views.begin() + static_cast<std::ptrdiff_t>(last));
      return SharedFloor{{median(shared, &FloorView::camera_height_m), median(shared, &FloorView::camera_pitch_rad)},
                         static_cast<int>(shared.size())};
    }
  }
  return std::nullopt;
}

}  // namespace oikos::recording
