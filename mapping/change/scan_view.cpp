// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/scan_view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace oikos::mapping {

namespace {

constexpr int kTile_px = 4;
constexpr int kMinGap_px = 2;  ///< a single pixel without a reading is noise

bool isReading(float z) {
  return z > 0.0F && std::isfinite(z);
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

ScanView::ScanView(const LocatedScan& scan, const ChangeConfig& config, double resolution_m)
    : scan_(scan), T_camera_map_(scan.T_map_camera.inverse()), config_(config), resolution_m_(resolution_m) {
  OIKOS_CHECK(scan.depth_m.type() == CV_32FC1 && scan.depth_m.cols == scan.camera.width && scan.depth_m.rows == scan.camera.height);
  OIKOS_CHECK(scan.T_map_camera.matrix().allFinite() && scan.covariance.allFinite());
  OIKOS_CHECK((scan.covariance - scan.covariance.transpose()).cwiseAbs().maxCoeff() <= 1e-9 &&
              scan.covariance.diagonal().minCoeff() >= 0.0);
  fillTiles();
  sumMissing();
}

void ScanView::fillTiles() {
  const cv::Mat& depth = scan_.depth_m;
  tile_columns_ = depth.cols / kTile_px;
  tile_rows_ = depth.rows / kTile_px;
  for (int row = 0; row < tile_rows_; ++row) {
    for (int column = 0; column < tile_columns_; ++column) {
      float nearest_m = std::numeric_limits<float>::infinity();
      for (int v = row * kTile_px; v < (row + 1) * kTile_px; ++v) {
        for (int u = column * kTile_px; u < (column + 1) * kTile_px; ++u) {
          const float z = depth.ptr<float>(v)[u];
          nearest_m = isReading(z) ? std::min(nearest_m, z) : nearest_m;
        }
      }
      tiles_.push_back(nearest_m);
    }
  }
}

void ScanView::sumMissing() {
  const cv::Mat& depth = scan_.depth_m;
  missing_ = cv::Mat(depth.rows + 1, depth.cols + 1, CV_32SC1, cv::Scalar(0));
  for (int v = 0; v < depth.rows; ++v) {
    const int* above = missing_.ptr<int>(v);
    int* below = missing_.ptr<int>(v + 1);
    int in_row = 0;
    for (int u = 0; u < depth.cols; ++u) {
      in_row += isReading(depth.ptr<float>(v)[u]) ? 0 : 1;
      below[u + 1] = above[u + 1] + in_row;
    }
  }
}

std::optional<ScanView::Window> ScanView::findWindow(const Eigen::Vector2d& pixel, double radius_px) const {
  const auto tileOf = [](double px) { return static_cast<int>(std::floor((px + 0.5) / kTile_px)); };
  const Window window{tileOf(pixel.x() - radius_px), tileOf(pixel.x() + radius_px), tileOf(pixel.y() - radius_px),
                      tileOf(pixel.y() + radius_px)};
  const bool is_inside = window.left >= 0 && window.top >= 0 && window.right < tile_columns_ && window.bottom < tile_rows_;
  return is_inside ? std::optional(window) : std::nullopt;
}

float ScanView::nearest_m(const Window& window) const {
  float nearest_m = std::numeric_limits<float>::infinity();
  for (int row = window.top; row <= window.bottom; ++row) {
    const auto first = tiles_.begin() + static_cast<std::ptrdiff_t>(row) * tile_columns_;
    nearest_m = std::min(nearest_m, *std::min_element(first + window.left, first + window.right + 1));
  }
  return nearest_m;
}

bool ScanView::hasGap(const Window& window, int side_px) const {
  const int step_px = std::max(1, side_px / 4);
  const double most = config_.max_missing_share * side_px * side_px;
  const int last_u = (window.right + 1) * kTile_px - side_px;
  const int last_v = (window.bottom + 1) * kTile_px - side_px;
  for (int v = window.top * kTile_px; v <= last_v; v += step_px) {
    const int* above = missing_.ptr<int>(v);
    const int* below = missing_.ptr<int>(v + side_px);
    for (int u = window.left * kTile_px; u <= last_u; u += step_px) {
      if (below[u + side_px] - below[u] - above[u + side_px] + above[u] > most) {
        return true;
      }
    }
  }
  return false;
}

double ScanView::sigma_m(const Eigen::Vector3d& point_camera) const {
  Eigen::Matrix<double, 3, 6> J;  // T·exp(v, w) moves the point by R (v + w × p); R turns the ellipsoid only
  J << Eigen::Matrix3d::Identity(), -skew(point_camera);
  const Eigen::Matrix3d covariance = J * scan_.covariance * J.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
  const double depth_sigma_m = config_.depth_sigma_1m * point_camera.z() * point_camera.z();
  return std::sqrt(std::max(0.0, solver.eigenvalues()[2]) + depth_sigma_m * depth_sigma_m + config_.map_sigma_m * config_.map_sigma_m);
}

std::optional<double> ScanView::findTolerance_m(const Eigen::Vector3d& point_camera) const {
  const double half_diagonal_m = 0.5 * std::sqrt(3.0) * resolution_m_;
  const double tolerance_m = config_.sigmas * sigma_m(point_camera) + half_diagonal_m;
  return tolerance_m <= config_.max_tolerance_m ? std::optional(tolerance_m) : std::nullopt;
}

Sighting ScanView::look(const Eigen::Vector3d& point_map, double tolerance_share) const {
  const Eigen::Vector3d point_camera = T_camera_map_ * point_map;
  if (point_camera.z() < config_.surface.min_depth_m || point_camera.z() > config_.surface.max_depth_m) {
    return {};
  }
  const Eigen::Vector2d pixel = scan_.camera.project(point_camera);
  if (!scan_.camera.contains(pixel)) {
    return {};
  }
  const auto tolerance_m = findTolerance_m(point_camera);
  if (!tolerance_m) {
    return {};
  }
  const double clear_m = tolerance_share * *tolerance_m;
  const double px_per_m = std::max(scan_.camera.fx, scan_.camera.fy) / point_camera.z();
  if (const auto window = findWindow(pixel, clear_m * px_per_m)) {
    const double nearest_m = this->nearest_m(*window);
    // A thing that gives no reading, as poles and legs often do, leaves a gap of its size: a share of the window would forget it.
    const int voxel_px = std::max(kMinGap_px, static_cast<int>(std::lround(resolution_m_ * px_per_m)));
    if (nearest_m > point_camera.z() + clear_m && !hasGap(*window, voxel_px)) {
      return {Sight::kThrough, (nearest_m - point_camera.z()) / std::max(1e-6, sigma_m(point_camera))};
    }
  }
  const double depth_m = scan_.depth_m.at<float>(static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
  return {std::abs(depth_m - point_camera.z()) <= *tolerance_m ? Sight::kNearSurface : Sight::kNothing, 0.0};
}

}  // namespace oikos::mapping
