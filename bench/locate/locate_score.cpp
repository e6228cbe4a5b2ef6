// SPDX-License-Identifier: Apache-2.0
#include "bench/locate/locate_score.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace oikos::bench {

namespace {

/// Lower end of Wilson's interval at 95 %.
double wilsonLow(int good, int all) {
  constexpr double kZ = 1.96;
  const double n = all;
  const double p = good / n;
  return (p + kZ * kZ / (2 * n) - kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n))) / (1 + kZ * kZ / n);
}

template <class Value>
std::vector<double> ofFound(const std::vector<FrameScore>& scores, Value value) {
  std::vector<double> values;
  for (const FrameScore& s : scores) {
    if (s.found) {
      values.push_back(value(s));
    }
  }
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) {
    sum += v;
  }
  return sum / static_cast<double>(values.size());
}

}  // namespace

FrameScore scoreFrame(const Eigen::Isometry3d& T_map_camera, const Eigen::Isometry3d& T_map_camera_true,
                      const geometry::Matrix6d& covariance) {
  const geometry::Vector6d xi = geometry::logSe3(T_map_camera.inverse() * T_map_camera_true);
  FrameScore score;
  score.found = true;
  score.error_m = (T_map_camera.translation() - T_map_camera_true.translation()).norm();
  score.error_deg = xi.tail<3>().norm() * 180.0 / 3.14159265358979;
  score.nees = xi.dot(covariance.ldlt().solve(xi));
  return score;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void printScoreHead() {
  std::printf("%-26s %6s %6s %8s %6s | %7s %7s %7s | %6s %6s %6s | %6s %6s | %8s %8s\n", "", "frames", "found", "5cm,5deg", "low", "med cm",
              "mean", "p95", "med d", "mean", "p95", "NEES/6", "n95", "ms med", "ms p95");
}

void printFrameScores(const std::string& name, const std::vector<FrameScore>& scores) {
  const auto metres = ofFound(scores, [](const FrameScore& s) { return 100.0 * s.error_m; });
  const auto degrees = ofFound(scores, [](const FrameScore& s) { return s.error_deg; });
  const auto nees = ofFound(scores, [](const FrameScore& s) { return s.nees; });
  const auto latency = ofFound(scores, [](const FrameScore& s) { return 1000.0 * s.latency_s; });
  const int all = static_cast<int>(scores.size());
  const auto good = static_cast<int>(
      std::count_if(scores.begin(), scores.end(), [](const FrameScore& s) { return s.found && s.error_m <= 0.05 && s.error_deg <= 5.0; }));
  if (metres.empty()) {
    std::printf("%-26s %6d %6d\n", name.c_str(), all, 0);
    return;
  }
  constexpr double kChi6Of95 = 12.592;
  const auto honest = std::count_if(nees.begin(), nees.end(), [](double n) { return n <= kChi6Of95; });
  std::printf("%-26s %6d %6zu %7.1f%% %5.1f%% | %7.2f %7.2f %7.2f | %6.2f %6.2f %6.2f | %6.2f %5.1f%% | %8.1f %8.1f\n", name.c_str(), all,
              metres.size(), 100.0 * good / all, 100.0 * wilsonLow(good, all), quantile(metres, 0.5), mean(metres), quantile(metres, 0.95),
              quantile(degrees, 0.5), mean(degrees), quantile(degrees, 0.95), mean(nees) / 6.0,
              100.0 * static_cast<double>(honest) / static_cast<double>(nees.size()), quantile(latency, 0.5), quantile(latency, 0.95));
}

}  // namespace oikos::bench
