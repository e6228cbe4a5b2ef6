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
}

void ScanView::fillTiles() {
  const cv::Mat& depth = scan_.depth_m;
  tile_columns_ = depth.cols / kTile_px;
  tile_rows_ = depth.rows / kTile_px;
  for (int row = 0; row < tile_rows_; ++row) {
    for (int column = 0; column < tile_columns_; ++column) {
      Tile tile{std::numeric_limits<float>::infinity(), 0};
      for (int v = row * kTile_px; v < (row + 1) * kTile_px; ++v) {
        for (int u = column * kTile_px; u < (column + 1) * kTile_px; ++u) {
          const float z = depth.ptr<float>(v)[u];
          const bool is_reading = z > 0.0F && std::isfinite(z);
          tile.nearest_m = is_reading ? std::min(tile.nearest_m, z) : tile.nearest_m;
          tile.missing += is_reading ? 0 : 1;
        }
      }
      tiles_.push_back(tile);
    }
  }
}

std::optional<ScanView::Window> ScanView::findWindow(const Eigen::Vector2d& pixel, double radius_px) const {
  const auto tileOf = [](double px) { return static_cast<int>(std::floor((px + 0.5) / kTile_px)); };
  const int left = tileOf(pixel.x() - radius_px);
  const int right = tileOf(pixel.x() + radius_px);
  const int top = tileOf(pixel.y() - radius_px);
  const int bottom = tileOf(pixel.y() + radius_px);
  if (left < 0 || top < 0 || right >= tile_columns_ || bottom >= tile_rows_) {
    return std::nullopt;
  }
  float nearest_m = std::numeric_limits<float>::infinity();
  int missing = 0;
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const Tile& tile = tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(tile_columns_) + static_cast<std::size_t>(column)];
      nearest_m = std::min(nearest_m, tile.nearest_m);
      missing += tile.missing;
    }
  }
  const int pixels = (right - left + 1) * (bottom - top + 1) * kTile_px * kTile_px;
  return Window{nearest_m, static_cast<double>(missing) / pixels};
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
  const auto window = findWindow(pixel, clear_m * std::max(scan_.camera.fx, scan_.camera.fy) / point_camera.z());
  if (window && window->missing_share <= config_.max_missing_share && window->nearest_m > point_camera.z() + clear_m) {
    return {Sight::kThrough, (window->nearest_m - point_camera.z()) / std::max(1e-6, sigma_m(point_camera))};
  }
  const double depth_m = scan_.depth_m.at<float>(static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
  return {std::abs(depth_m - point_camera.z()) <= *tolerance_m ? Sight::kNearSurface : Sight::kNothing, 0.0};
}

}  // namespace oikos::mapping
