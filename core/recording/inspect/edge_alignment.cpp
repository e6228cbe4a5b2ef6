// SPDX-License-Identifier: Apache-2.0
#include "core/recording/inspect/edge_alignment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace oikos::recording {

namespace {

constexpr int kSearch_px = 10;           // between the near and the far side there may be a shadow without depth
constexpr float kLeastRatio = 1.12F;     // far over near
constexpr float kFarthest_m = 4.0F;      // beyond, sensor noise makes edges of its own
constexpr int kStrongestGradient = 120;  // a few very strong colour edges must not outvote the rest

/// Two images seen along rows or along columns, so that one search serves both directions.
struct Scan {
  const cv::Mat& depth_m;
  const cv::Mat& gradient;  ///< CV_16SC1, along the scan
  bool along_rows;
  [[nodiscard]] int lines() const { return along_rows ? depth_m.rows : depth_m.cols; }
  [[nodiscard]] int length() const { return along_rows ? depth_m.cols : depth_m.rows; }
  [[nodiscard]] float depth(int line, int i) const { return along_rows ? depth_m.at<float>(line, i) : depth_m.at<float>(i, line); }
  [[nodiscard]] int strength(int line, int i) const {
    const int value = along_rows ? gradient.at<std::int16_t>(line, i) : gradient.at<std::int16_t>(i, line);
    return std::min(std::abs(value), kStrongestGradient);
  }
};

/// Whether the surface goes on inside (against the step) and ends at i: all but the near neighbours beyond are far or unknown, and one is
/// far.
bool isEdge(const Scan& scan, int line, int i, int step) {
  const float near = scan.depth(line, i);
  if (!(near > 0.3F && near < kFarthest_m)) {
    return false;
  }
  for (int back = 1; back <= 3; ++back) {
    if (!(std::abs(scan.depth(line, i - back * step) - near) < 0.03F * near)) {
      return false;
    }
  }
  for (int ahead = 1; ahead <= kSearch_px; ++ahead) {
    const float other = scan.depth(line, i + ahead * step);
    if (!std::isnan(other)) {
      return other > kLeastRatio * near;
    }
  }
  return false;
}

void addEdge(const Scan& scan, int line, int i, EdgeProfile& profile) {
  ++profile.edges;
  for (int shift = -kLargestEdgeShift_px; shift <= kLargestEdgeShift_px; ++shift) {
    profile.gradient[static_cast<std::size_t>(shift + kLargestEdgeShift_px)] += scan.strength(line, i + shift);
  }
}

constexpr int kLineStep = 2;
constexpr int kMargin = kLargestEdgeShift_px + 1;

/// CV_8UC1 mask, a row for each line looked at, a column for each place on it.
cv::Mat markEdges(const Scan& scan, int step) {
  cv::Mat marks(scan.lines() / kLineStep, scan.length(), CV_8UC1, cv::Scalar(0));
  for (int row = 0; row < marks.rows; ++row) {
    for (int i = kMargin; i < scan.length() - kMargin; ++i) {
      marks.at<std::uint8_t>(row, i) = isEdge(scan, row * kLineStep, i, step) ? 1 : 0;
    }
  }
  return marks;
}

/// A slanted edge cannot tell a shift along the scan from one across it: edges count only if they run on, within 1 px, two rows farther on
/// both sides.
void addEdgesAcross(const cv::Mat& marks, const Scan& scan, EdgeProfile& profile) {
  constexpr int kNeighbour = 2;
  const auto runsOn = [&marks](int row, int i) {
    const auto* around = marks.ptr<std::uint8_t>(row) + i;
    return around[-1] != 0 || around[0] != 0 || around[1] != 0;
  };
  for (int row = kNeighbour; row < marks.rows - kNeighbour; ++row) {
    for (int i = kMargin; i < marks.cols - kMargin; ++i) {
      if (marks.at<std::uint8_t>(row, i) != 0 && runsOn(row - kNeighbour, i) && runsOn(row + kNeighbour, i)) {
        addEdge(scan, row * kLineStep, i, profile);
      }
    }
  }
}

void profileScan(const Scan& scan, EdgeProfile& low_side, EdgeProfile& high_side) {
  addEdgesAcross(markEdges(scan, -1), scan, low_side);
  addEdgesAcross(markEdges(scan, 1), scan, high_side);
}

using Curve = std::array<double, 2 * kLargestEdgeShift_px + 1>;

/// Smoothed and divided by its mean, so that both sides of things have the same say whatever their number.
Curve relativeCurve(const EdgeProfile& profile) {
  const auto& g = profile.gradient;
  Curve curve{};
  double mean = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const std::size_t before = i == 0 ? i : i - 1;
    const std::size_t after = i + 1 == g.size() ? i : i + 1;
    curve[i] = 0.25 * static_cast<double>(g[before]) + 0.5 * static_cast<double>(g[i]) + 0.25 * static_cast<double>(g[after]);
    mean += curve[i] / static_cast<double>(g.size());
  }
  for (double& value : curve) {
    value = mean > 0.0 ? value / mean : 0.0;
  }
  return curve;
}

/// For each shift the mean of both sides, at the best width of the things between them (sensors make them up to a few pixels too fat or
/// thin).
Curve joinSides(const Curve& low, const Curve& high) {
  constexpr int kLargestFat_px = 2;
  const int size = static_cast<int>(low.size());
  Curve joined{};
  for (int i = 0; i < size; ++i) {
    for (int fat = -kLargestFat_px; fat <= kLargestFat_px; ++fat) {
      const auto at_low = static_cast<std::size_t>(std::clamp(i + fat, 0, size - 1));
      const auto at_high = static_cast<std::size_t>(std::clamp(i - fat, 0, size - 1));
      joined[static_cast<std::size_t>(i)] = std::max(joined[static_cast<std::size_t>(i)], 0.5 * (low[at_low] + high[at_high]));
    }
  }
  return joined;
}

/// Position of the peak at `best` between the samples, by a parabola.
double refinePeak(const Curve& curve, std::size_t best) {
  if (best == 0 || best + 1 == curve.size()) {
    return static_cast<double>(best);
  }
  const double curvature = curve[best - 1] - 2.0 * curve[best] + curve[best + 1];
  return static_cast<double>(best) + (curvature < 0.0 ? 0.5 * (curve[best - 1] - curve[best + 1]) / curvature : 0.0);
}

EdgeProfile& side(EdgeProfiles& profiles, EdgeSide side) {
  return profiles[static_cast<std::size_t>(side)];
}

}  // namespace

EdgeProfiles profileDepthEdges(const camera::RgbdFrame& frame) {
  cv::Mat smooth;
  cv::GaussianBlur(frame.gray, smooth, {3, 3}, 0.0);
  cv::Mat along_u;
  cv::Mat along_v;
  cv::Sobel(smooth, along_u, CV_16S, 1, 0, 3, 0.25);
  cv::Sobel(smooth, along_v, CV_16S, 0, 1, 3, 0.25);
  EdgeProfiles profiles;
  profileScan({frame.depth_m, along_u, true}, side(profiles, EdgeSide::kLeft), side(profiles, EdgeSide::kRight));
  profileScan({frame.depth_m, along_v, false}, side(profiles, EdgeSide::kTop), side(profiles, EdgeSide::kBottom));
  return profiles;
}

void addProfiles(const EdgeProfiles& more, EdgeProfiles& sum) {
  for (std::size_t s = 0; s < sum.size(); ++s) {
    sum[s].edges += more[s].edges;
    for (std::size_t i = 0; i < sum[s].gradient.size(); ++i) {
      sum[s].gradient[i] += more[s].gradient[i];
    }
  }
}

EdgeShift findEdgeShift(const EdgeProfile& low_side, const EdgeProfile& high_side) {
  constexpr int kFewestEdges = 300;
  constexpr double kLeastPeak = 1.3;  // over the mean of all shifts
  EdgeShift shift;
  shift.edges = low_side.edges + high_side.edges;
  const Curve joined = joinSides(relativeCurve(low_side), relativeCurve(high_side));
  const auto best = static_cast<std::size_t>(std::max_element(joined.begin(), joined.end()) - joined.begin());
  shift.shift_px = refinePeak(joined, best) - kLargestEdgeShift_px;
  shift.is_known = std::min(low_side.edges, high_side.edges) >= kFewestEdges && joined[best] >= kLeastPeak;
  return shift;
}

}  // namespace oikos::recording
