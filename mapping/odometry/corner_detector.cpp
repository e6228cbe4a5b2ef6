// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/corner_detector.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/camera/depth_noise.h"

namespace oikos::mapping {

namespace {

constexpr int kBorder_px = 9;
constexpr int kCandidatesPerCell = 3;

struct InverseDepthPlane {
  double inverse_depth;
  Eigen::Vector2d gradient;
  double sigma;
};

struct Reading {
  double x, y;  ///< offset from the centre, pixels
  double inverse_depth;
};

struct Window {
  std::vector<Reading> readings;
  int pixels = 0;
};

Window readWindow(const cv::Mat& depth_m, const Eigen::Vector2i& centre, int radius) {
  Window window;
  for (int y = std::max(0, centre.y() - radius); y <= std::min(depth_m.rows - 1, centre.y() + radius); ++y) {
    const float* row = depth_m.ptr<float>(y);
    for (int x = std::max(0, centre.x() - radius); x <= std::min(depth_m.cols - 1, centre.x() + radius); ++x) {
      ++window.pixels;
      if (row[x] > 0.0F) {
        window.readings.push_back(
            {static_cast<double>(x - centre.x()), static_cast<double>(y - centre.y()), 1.0 / static_cast<double>(row[x])});
      }
    }
  }
  return window;
}

/// Least squares plane through inverse depths; nothing where no plane fits them.
std::optional<InverseDepthPlane> fitPlane(const std::vector<Reading>& readings, const CornerDetectorConfig& config) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double squares = 0.0;
  for (const Reading& r : readings) {
    const Eigen::Vector3d j(r.x, r.y, 1.0);
    A.noalias() += j * j.transpose();
    b += r.inverse_depth * j;
    squares += r.inverse_depth * r.inverse_depth;
  }
  const Eigen::Vector3d plane = A.ldlt().solve(b);
  const double variance = std::max(0.0, (squares - plane.dot(b)) / static_cast<double>(readings.size()));
  if (!plane.allFinite() || plane.z() < 1.0 / config.max_depth_m) {
    return std::nullopt;
  }
  const double expected = camera::inverseDepthSigma(1.0 / plane.z());
  if (std::sqrt(variance) > config.max_plane_residual * expected) {
    return std::nullopt;
  }
  // Neighbouring readings share their error: the mean of a window is hardly better than half a reading's deviation.
  return InverseDepthPlane{plane.z(), plane.head<2>(), std::max(0.5 * expected, std::sqrt(variance) * 0.5)};
}

/// The surface at a corner. Where the window holds an edge, the nearer side: texture at an edge mostly belongs to it.
std::optional<InverseDepthPlane> fitSurface(const cv::Mat& depth_m, const Eigen::Vector2i& centre, const CornerDetectorConfig& config) {
  constexpr double kNearerSide = 0.93;  ///< of the greatest inverse depth
  Window window = readWindow(depth_m, centre, config.depth_window_px);
  if (static_cast<int>(window.readings.size()) * 10 < window.pixels * 3) {
    return std::nullopt;
  }
  if (static_cast<int>(window.readings.size()) * 10 >= window.pixels * 6) {
    if (auto plane = fitPlane(window.readings, config)) {
      return plane;
    }
  }
  std::vector<Reading>& readings = window.readings;
  const auto tenth = readings.begin() + static_cast<std::ptrdiff_t>(readings.size() / 10);
  std::nth_element(readings.begin(), tenth, readings.end(),
                   [](const Reading& a, const Reading& b) { return a.inverse_depth > b.inverse_depth; });
  const double nearest = tenth->inverse_depth;
  std::erase_if(readings, [&](const Reading& r) { return r.inverse_depth < kNearerSide * nearest; });
  if (static_cast<int>(readings.size()) * 10 < window.pixels * 3) {
    return std::nullopt;
  }
  auto plane = fitPlane(readings, config);
  if (plane) {
    plane->sigma *= 2.0;
    plane->gradient.setZero();
  }
  return plane;
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
      const bool peak = r > row[x - 1] && r >= row[x + 1] && r > above[-1] && r > above[0] && r > above[1] && r >= below[-1] &&
                        r >= below[0] && r >= below[1];
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

struct FoundCorner {
  float response;
  Landmark landmark;
};

/// Looks for landmarks in the cells that hold none.
class CellSearch {
 public:
  CellSearch(const camera::RgbdFrame& frame, const std::vector<Eigen::Vector2d>& occupied, const CornerDetectorConfig& config)
      : frame_(frame),
        config_(config),
        cell_px_(std::max(12, config.cell_px * frame.gray.cols / 640)),
        response_(cornerResponse(frame.gray)) {
    columns_ = (frame.gray.cols + cell_px_ - 1) / cell_px_;
    const int rows = (frame.gray.rows + cell_px_ - 1) / cell_px_;
    taken_.resize(static_cast<std::size_t>(columns_ * rows), 0);
    for (const Eigen::Vector2d& px : occupied) {
      const int column = std::clamp(static_cast<int>(px.x()) / cell_px_, 0, columns_ - 1);
      const int row = std::clamp(static_cast<int>(px.y()) / cell_px_, 0, rows - 1);
      taken_[static_cast<std::size_t>(row * columns_ + column)] = 1;
    }
  }

  /// The strongest corner of each empty cell that lies on a known surface, cell by cell; their cells are empty no more.
  std::vector<FoundCorner> find(double min_response) {
    std::vector<FoundCorner> found;
    for (std::size_t cell = 0; cell < taken_.size(); ++cell) {
      if (taken_[cell] == 0) {
        if (auto corner = findIn(static_cast<int>(cell), min_response)) {
          taken_[cell] = 1;
          found.push_back(*corner);
        }
      }
    }
    return found;
  }

 private:
  [[nodiscard]] std::optional<FoundCorner> findIn(int cell, double min_response) const {
    const cv::Rect area(cell % columns_ * cell_px_, cell / columns_ * cell_px_, cell_px_, cell_px_);
    for (const Corner& corner : strongest(response_, area, min_response)) {
      if (const auto plane = fitSurface(frame_.depth_m, {corner.x, corner.y}, config_)) {
        return FoundCorner{corner.response,
                           {-1, {corner.x, corner.y}, plane->inverse_depth, plane->inverse_depth, plane->sigma, plane->gradient}};
      }
    }
    return std::nullopt;
  }

  const camera::RgbdFrame& frame_;
  const CornerDetectorConfig& config_;
  int cell_px_;
  int columns_ = 0;
  cv::Mat response_;
  std::vector<char> taken_;
};

}  // namespace

std::vector<Landmark> detectCorners(const camera::RgbdFrame& frame, const std::vector<Eigen::Vector2d>& occupied,
                                    const CornerDetectorConfig& config) {
  CellSearch search(frame, occupied, config);
  std::vector<FoundCorner> found = search.find(config.min_response);
  const auto enough = static_cast<std::size_t>(std::max(0, config.enough));
  if (occupied.size() + found.size() < enough) {
    std::vector<FoundCorner> weak = search.find(config.min_weak_response);
    std::stable_sort(weak.begin(), weak.end(), [](const FoundCorner& a, const FoundCorner& b) { return a.response > b.response; });
    weak.resize(std::min(weak.size(), enough - occupied.size() - found.size()));
    found.insert(found.end(), weak.begin(), weak.end());
  }
  std::vector<Landmark> landmarks;
  landmarks.reserve(found.size());
  for (const FoundCorner& corner : found) {
    landmarks.push_back(corner.landmark);
  }
  return landmarks;
}

}  // namespace oikos::mapping
