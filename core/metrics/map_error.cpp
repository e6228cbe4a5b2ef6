// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/map_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nanoflann.hpp>
#include <utility>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/parallel.h"

namespace oikos::metrics {

namespace {

using Points = std::vector<Eigen::Vector3f>;

/// What nanoflann asks of a set of points; the names are its own.
struct PointSet {
  const Points& points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t index, std::size_t axis) const { return points[index][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointSet, double>, PointSet, 3, std::uint32_t>;

constexpr std::size_t kPointsPerChunk = 4096;

double distanceToNearest(const Tree& tree, const Points& reference, const Eigen::Vector3f& point) {
  std::uint32_t index = 0;
  double distance_sq = 0.0;
  tree.knnSearch(point.data(), 1, &index, &distance_sq);
  return (point.cast<double>() - reference[index].cast<double>()).norm();
}

CloudDistance distanceBetween(const Points& from, const Points& to, const MapErrorConfig& config) {
  const PointSet set{to};
  const Tree tree(3, set, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  std::vector<double> distances_m(from.size());
  const std::size_t chunks = (from.size() + kPointsPerChunk - 1) / kPointsPerChunk;
  base::parallelFor(static_cast<int>(chunks), config.threads, [&](int chunk) {
    const std::size_t begin = static_cast<std::size_t>(chunk) * kPointsPerChunk;
    const std::size_t end = std::min(begin + kPointsPerChunk, from.size());
    for (std::size_t i = begin; i < end; ++i) {
      distances_m[i] = distanceToNearest(tree, to, from[i]);
    }
  });
  const auto shareWithin = [&distances_m](double limit_m) {
    const auto within = std::count_if(distances_m.begin(), distances_m.end(), [limit_m](double d) { return d <= limit_m; });
    return static_cast<double>(within) / static_cast<double>(distances_m.size());
  };
  CloudDistance result;
  result.share_within_fine = shareWithin(config.fine_m);
  result.share_within_coarse = shareWithin(config.coarse_m);
  result.distance_m = statisticsOf(std::move(distances_m));
  return result;
}

bool allFinite(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](const Eigen::Vector3f& point) { return point.allFinite(); });
}

}  // namespace

std::vector<std::string> MapErrorConfig::validate() const {
  std::vector<std::string> problems;
  const auto requirePositive = [&problems](const char* name, double value) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      problems.push_back(std::string("map_error.") + name + " = " + base::toText(value) + ": must be > 0");
    }
  };
  requirePositive("fine_m", fine_m);
  requirePositive("coarse_m", coarse_m);
  if (threads < 1) {
    problems.push_back("map_error.threads = " + std::to_string(threads) + ": must be >= 1");
  }
  return problems;
}

MapError evaluateMap(const Points& cloud_map, const Points& reference_map, const MapErrorConfig& config) {
  OIKOS_CHECK(config.validate().empty());
  MapError result;
  if (cloud_map.empty() || reference_map.empty()) {
    result.status = cloud_map.empty() ? MapErrorStatus::kEmptyCloud : MapErrorStatus::kEmptyReference;
    return result;
  }
  if (!allFinite(cloud_map) || !allFinite(reference_map)) {
    result.status = MapErrorStatus::kNonFinite;
    return result;
  }
  result.accuracy = distanceBetween(cloud_map, reference_map, config);
  result.completeness = distanceBetween(reference_map, cloud_map, config);
  result.status = MapErrorStatus::kEvaluated;
  return result;
}

}  // namespace oikos::metrics
