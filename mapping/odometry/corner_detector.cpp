// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/corner_detector.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "mapping/odometry/depth_noise.h"

namespace oikos::mapping {

namespace {

constexpr int kBorder_px = 9;
constexpr int kCandidatesPerCell = 3;

struct InverseDepthPlane {
  double inverse_depth;
  Eigen::Vector2d gradient;
  double sigma;
};

/// Least squares plane through the window's inverse depths; nothing where readings are few or no plane fits them.
std::optional<InverseDepthPlane> fitSurface(const cv::Mat& depth_m, const Eigen::Vector2i& centre, const CornerDetectorConfig& config) {
  const int radius = config.depth_window_px;
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int readings = 0;
  int pixels = 0;
  for (int y = centre.y() - radius; y <= centre.y() + radius; y += 2) {
    if (y < 0 || y >= depth_m.rows) {
      continue;
    }
    for (int x = centre.x() - radius; x <= centre.x() + radius; x += 2) {
      if (x < 0 || x >= depth_m.cols) {
        continue;
      }
      ++pixels;
      const double z = depth_m.at<float>(y, x);
      if (!(z > 0.0)) {
        continue;
      }
      const Eigen::Vector3d j(x - centre.x(), y - centre.y(), 1.0);
      const double inverse = 1.0 / z;
      A.noalias() += j * j.transpose();
      b += inverse * j;
      squares += inverse * inverse;
      ++readings;
    }
  }
  if (readings < 12 || readings * 10 < pixels * 6) {
    return std::nullopt;
  }
  const Eigen::Vector3d plane = A.ldlt().solve(b);
  const double variance = std::max(0.0, (squares - plane.dot(b)) / readings);
  if (!plane.allFinite() || plane.z() < 1.0 / config.max_depth_m) {
    return std::nullopt;
  }
  const double expected = inverseDepthSigma(1.0 / plane.z());
  if (std::sqrt(variance) > config.max_plane_residual * expected) {
    return std::nullopt;
  }
  // Neighbouring readings share their error: the mean of a window is hardly better than half a reading's deviation.
  return InverseDepthPlane{plane.z(), plane.head<2>(), std::max(0.5 * expected, std::sqrt(variance) * 0.5)};
}

struct Corner {
  float response;
  int x, y;
};

/// The strongest local maxima of a cell, strongest first.
std::vector<Corner> strongest(const cv::Mat& response, const cv::Rect& cell, double min_response) {
  std::vector<Corner> corners;
  for (int y = std::max(cell.y, kBorder_px); y < std::min(cell.y + cell.height, response.rows - kBorder_px); ++y) {
    const float* row = response.ptr<float>(y);
    for (int x = std::max(cell.x, kBorder_px); x < std::min(cell.x + cell.width, response.cols - kBorder_px); ++x) {
      const float r = row[x];
      if (r < static_cast<float>(min_response)) {
        continue;
      }
      const float* above = response.ptr<float>(y - 1) + x;
      const float* below = response.ptr<float>(y + 1) + x;
      const bool peak = r > row[x - 1] && r >= row[x + 1] && r > above[-1] && r > above[0] && r > above[1] && r >= below[-1] && r >= below[0] && r >= below[1];
      if (peak) {
        corners.push_back({r, x, y});
      }
    }
  }
  std::stable_sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.response > b.response; });
  if (corners.size() > kCandidatesPerCell) {
    corners.resize(kCandidatesPerCell);
  }
  return corners;
}

cv::Mat cornerResponse(const cv::Mat& gray) {
  cv::Mat response;
  constexpr int kBlock = 5;
  cv::cornerMinEigenVal(gray, response, kBlock, 3);
  // OpenCV scales its 8-bit Sobel sums by 1 / (255 * 4 * block): back to squared grey values per pixel, mean over the block.
  constexpr double kToGrey = 255.0 * 4.0 * kBlock / 8.0;
  response *= kToGrey * kToGrey / (kBlock * kBlock);
  return response;
}

}  // namespace

std::vector<Landmark> detectCorners(const camera::RgbdFrame& frame, const std::vector<Eigen::Vector2d>& occupied,
                                    const CornerDetectorConfig& config) {
  const int cell_px = std::max(12, config.cell_px * frame.gray.cols / 640);
  const int columns = (frame.gray.cols + cell_px - 1) / cell_px;
  const int rows = (frame.gray.rows + cell_px - 1) / cell_px;
  std::vector<char> taken(static_cast<std::size_t>(columns * rows), 0);
  for (const Eigen::Vector2d& px : occupied) {
    const int column = std::clamp(static_cast<int>(px.x()) / cell_px, 0, columns - 1);
    const int row = std::clamp(static_cast<int>(px.y()) / cell_px, 0, rows - 1);
    taken[static_cast<std::size_t>(row * columns + column)] = 1;
  }
  const cv::Mat response = cornerResponse(frame.gray);
  std::vector<Landmark> landmarks;
  for (int cell = 0; cell < columns * rows; ++cell) {
    if (taken[static_cast<std::size_t>(cell)] != 0) {
      continue;
    }
    const cv::Rect area(cell % columns * cell_px, cell / columns * cell_px, cell_px, cell_px);
    for (const Corner& corner : strongest(response, area, config.min_response)) {
      if (const auto plane = fitSurface(frame.depth_m, {corner.x, corner.y}, config)) {
        landmarks.push_back({-1, {corner.x, corner.y}, plane->inverse_depth, plane->inverse_depth, plane->sigma, plane->gradient});
        break;
      }
    }
  }
  return landmarks;
}

}  // namespace oikos::mapping
