// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/front_plane.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/config_rules.h"
#include "core/geometry/outline_area.h"
#include "registration/handles/pixel_area.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTukey = 4.685;
constexpr int kRounds = 6;
constexpr double kHides_m = 0.12;  // what is so far before a front is not a part of it

/// A reading near the believed front.
struct FrontReading {
  Eigen::Vector3d at_front = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;  ///< along x
  double weight = 1.0;
};

struct Gathered {
  std::vector<FrontReading> readings;
  int nearer = 0;
  double share = 1.0;  ///< of a reading's information that counts: neighbours repeat each other
};

Eigen::AlignedBox2d enlarged(const Eigen::AlignedBox2d& box, double margin_m) {
  return {box.min().array() - margin_m, box.max().array() + margin_m};
}

Gathered gather(const Eigen::AlignedBox2d& outline, const std::vector<Eigen::AlignedBox2d>& left_out, const DepthView& view,
                const Eigen::Isometry3d& T_camera_front, const FrontPlaneConfig& config) {
  Gathered gathered;
  const PixelArea area = pixelsOf(outline, T_camera_front, view.camera, config.most_readings);
  gathered.share = std::min(1.0, area.step_px * area.step_px / (config.correlation_px * config.correlation_px));
  const Eigen::Isometry3d T_front_camera = T_camera_front.inverse();
  const Eigen::RowVector3d normal_camera = T_front_camera.linear().row(0);
  for (int v = area.box.top; v < area.box.bottom; v += area.step_px) {
    const float* row = view.depth_m.ptr<float>(v);
    for (int u = area.box.left; u < area.box.right; u += area.step_px) {
      const auto z_m = static_cast<double>(row[u]);
      if (!(z_m > 0.0)) {
        continue;
      }
      const Eigen::Vector3d ray = view.camera.ray(u, v);
      const Eigen::Vector3d at_front = T_front_camera * (z_m * ray);
      if (!outline.contains(Eigen::Vector2d(at_front.tail<2>()))) {
        continue;
      }
      gathered.nearer += at_front.x() > kHides_m ? 1 : 0;
      const bool is_left_out = std::any_of(left_out.begin(), left_out.end(), [&](const Eigen::AlignedBox2d& box) {
        return box.contains(Eigen::Vector2d(at_front.tail<2>()));
      });
      if (std::abs(at_front.x()) < config.gate_m && !is_left_out) {
        gathered.readings.push_back({at_front, readingSigma_m(z_m) * std::abs(normal_camera * ray) + 0.0002, 1.0});
      }
    }
  }
  return gathered;
}

struct Normals {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
};

/// The belief, about the outline's middle: there a door that turns too far is off as a whole.
Normals prior(const FrontPlaneConfig& config) {
  Normals normals;
  const double tilt = config.tilt_sigma_deg * kDegree;
  normals.H.diagonal() << 1.0 / (config.place_sigma_m * config.place_sigma_m), 1.0 / (tilt * tilt), 1.0 / (tilt * tilt);
  return normals;
}

Normals sumUp(const Gathered& gathered, const Eigen::Vector2d& middle, double scale, const FrontPlaneConfig& config) {
  Normals sums = prior(config);
  for (const FrontReading& reading : gathered.readings) {
    const Eigen::Vector3d J(1.0, reading.at_front.y() - middle.x(), reading.at_front.z() - middle.y());
    const double sigma_m = scale * reading.sigma_m;
    const double weight = gathered.share * reading.weight / (sigma_m * sigma_m);
    sums.H += weight * J * J.transpose();
    sums.g += weight * reading.at_front.x() * J;
  }
  return sums;
}

double residualOf(const FrontReading& reading, const Eigen::Vector3d& plane, const Eigen::Vector2d& middle) {
  return reading.at_front.x() - plane.dot(Eigen::Vector3d(1.0, reading.at_front.y() - middle.x(), reading.at_front.z() - middle.y()));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Robust ratio of what the readings deviate by to what the sensor is said to.
double scaleOf(const Gathered& gathered, const Eigen::Vector3d& plane, const Eigen::Vector2d& middle) {
  std::vector<double> ratios;
  ratios.reserve(gathered.readings.size());
  for (const FrontReading& reading : gathered.readings) {
    ratios.push_back(std::abs(residualOf(reading, plane, middle)) / reading.sigma_m);
  }
  return std::clamp(1.4826 * median(std::move(ratios)), 0.02, 4.0);
}

std::vector<Eigen::Vector2d> hullOf(const Gathered& gathered) {
  std::vector<cv::Point2f> points;
  for (const FrontReading& reading : gathered.readings) {
    if (reading.weight > 0.0) {
      points.emplace_back(static_cast<float>(reading.at_front.y()), static_cast<float>(reading.at_front.z()));
    }
  }
  std::vector<cv::Point2f> corners;
  cv::convexHull(points, corners, false);
  std::vector<Eigen::Vector2d> hull;
  for (const cv::Point2f& corner : corners) {
    hull.emplace_back(static_cast<double>(corner.x), static_cast<double>(corner.y));
  }
  if (geometry::signedDoubleArea(hull) < 0.0) {
    std::reverse(hull.begin(), hull.end());
  }
  return hull;
}

/// The believed frame moved onto x = c + a y + b z.
Eigen::Isometry3d moved(const Eigen::Isometry3d& T_camera_front, const Eigen::Vector3d& plane, const Eigen::Vector2d& middle) {
  const Eigen::Vector3d normal_front = Eigen::Vector3d(1.0, -plane[1], -plane[2]).normalized();
  Eigen::Isometry3d T = T_camera_front;
  T.translate(Eigen::Vector3d(plane[0] - plane[1] * middle.x() - plane[2] * middle.y(), 0.0, 0.0));
  T.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), normal_front));
  return T;
}

}  // namespace

std::vector<std::string> FrontPlaneConfig::validate() const {
  return base::ConfigRules()
      .greater("place_sigma_m", place_sigma_m, 0.0)
      .greater("tilt_sigma_deg", tilt_sigma_deg, 0.0)
      .greater("gate_m", gate_m, 0.0)
      .atLeast("margin_m", margin_m, 0.0)
      .atLeast("handle_margin_m", handle_margin_m, 0.0)
      .greater("correlation_px", correlation_px, 0.0)
      .atLeast("floor_m", floor_m, 0.0)
      .atLeast("floor_deg", floor_deg, 0.0)
      .atLeast("most_readings", most_readings, 100)
      .atLeast("min_readings", min_readings, 3)
      .messages();
}

FrontPlane fitFrontPlane(const FrontFace& face, const std::vector<Eigen::AlignedBox2d>& handles_front, const DepthView& view,
                         const Eigen::Isometry3d& T_camera_front, const FrontPlaneConfig& config) {
  std::vector<Eigen::AlignedBox2d> left_out;
  for (const Eigen::AlignedBox2d& handle : handles_front) {
    left_out.push_back(enlarged(handle, config.handle_margin_m));
  }
  Gathered gathered = gather(enlarged(face.outline_front, config.margin_m), left_out, view, T_camera_front, config);
  FrontPlane found;
  found.T_camera_front = T_camera_front;
  found.nearer = gathered.nearer;
  if (static_cast<int>(gathered.readings.size()) < config.min_readings) {
    return found;
  }
  const Eigen::Vector2d middle = face.outline_front.center();
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  Normals sums;
  double scale = 1.0;
  for (int round = 0; round < kRounds; ++round) {
    sums = sumUp(gathered, middle, scale, config);
    plane = sums.H.ldlt().solve(sums.g);
    scale = scaleOf(gathered, plane, middle);
    found.readings = 0;
    for (FrontReading& reading : gathered.readings) {
      const double ratio = residualOf(reading, plane, middle) / (kTukey * scale * reading.sigma_m);
      reading.weight = std::abs(ratio) < 1.0 ? (1.0 - ratio * ratio) * (1.0 - ratio * ratio) : 0.0;
      found.readings += reading.weight > 0.0 ? 1 : 0;
    }
  }
  if (found.readings < config.min_readings) {
    return found;
  }
  found.is_found = true;
  found.T_camera_front = moved(T_camera_front, plane, middle);
  Eigen::Matrix3d to_origin = Eigen::Matrix3d::Identity();
  to_origin.row(0) << 1.0, -middle.x(), -middle.y();
  const double floor = config.floor_deg * kDegree;
  Eigen::Matrix3d covariance = sums.H.inverse();
  covariance.diagonal() += Eigen::Vector3d(config.floor_m * config.floor_m, floor * floor, floor * floor);
  found.covariance = to_origin * covariance * to_origin.transpose();
  std::vector<double> sigmas;
  for (const FrontReading& reading : gathered.readings) {
    sigmas.push_back(reading.sigma_m);
  }
  found.sigma_m = scale * median(std::move(sigmas));
  found.hull_front = hullOf(gathered);
  return found;
}

bool isWithin(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& point, double margin_m) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d along = hull[(i + 1) % hull.size()] - hull[i];
    const Eigen::Vector2d to_point = point - hull[i];
    if (along.x() * to_point.y() - along.y() * to_point.x() < -margin_m * along.norm()) {
      return false;
    }
  }
  return !hull.empty();
}

}  // namespace oikos::registration
