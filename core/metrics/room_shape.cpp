// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/room_shape.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/config_rules.h"
#include "core/base/error.h"

namespace oikos::metrics {

namespace {

using Eigen::Vector2d;

/// An edge of the true outline.
struct Edge {
  Vector2d from;
  Vector2d along;  ///< length 1
  Vector2d normal;
  double length_m = 0.0;

  [[nodiscard]] Vector2d middle() const { return from + 0.5 * length_m * along; }
};

double crossOf(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Edge edgeOf(const std::vector<Vector2d>& outline_map, std::size_t i) {
  const Vector2d& from = outline_map[i];
  const Vector2d way = outline_map[(i + 1) % outline_map.size()] - from;
  const Vector2d along = way.normalized();
  return {from, along, {-along.y(), along.x()}, way.norm()};
}

/// Points about the wall, as (along, across) of its edge.
std::vector<Vector2d> pointsAbout(const Edge& edge, const std::vector<Eigen::Vector3f>& points_map, const RoomShapeConfig& config) {
  std::vector<Vector2d> points;
  for (const Eigen::Vector3f& point : points_map) {
    const Vector2d off = point.head<2>().cast<double>() - edge.from;
    const Vector2d place(off.dot(edge.along), off.dot(edge.normal));
    if (point.z() > config.lowest_m && point.z() < config.highest_m && std::abs(place.y()) < config.search_m &&
        place.x() > config.from_end_m && place.x() < edge.length_m - config.from_end_m) {
      points.push_back(place);
    }
  }
  return points;
}

/// Where across the wall most points are: pictures and furniture hold fewer than it does itself.
double peakAcross(const std::vector<Vector2d>& points, const RoomShapeConfig& config) {
  constexpr double kBin_m = 0.005;
  const auto bins = static_cast<std::size_t>(std::ceil(2.0 * config.search_m / kBin_m));
  std::vector<int> counts(bins + 2, 0);
  for (const Vector2d& point : points) {
    ++counts[1 + std::min(bins - 1, static_cast<std::size_t>((point.y() + config.search_m) / kBin_m))];
  }
  std::size_t best = 1;
  int most = -1;
  for (std::size_t i = 1; i <= bins; ++i) {
    const int sum = counts[i - 1] + counts[i] + counts[i + 1];
    if (sum > most) {
      most = sum;
      best = i;
    }
  }
  return -config.search_m + (static_cast<double>(best) - 0.5) * kBin_m;
}

/// across = offset + slope * along, by total least squares over the points near a line that starts level at the peak.
std::optional<WallLine> fitWall(const Edge& edge, const std::vector<Eigen::Vector3f>& points_map, const RoomShapeConfig& config) {
  constexpr int kRounds = 5;
  const std::vector<Vector2d> points = pointsAbout(edge, points_map, config);
  if (static_cast<int>(points.size()) < config.min_points) {
    return std::nullopt;
  }
  Vector2d normal = Vector2d::UnitY();
  double offset_m = peakAcross(points, config);
  for (int round = 0; round < kRounds; ++round) {
    int count = 0;
    Vector2d sum = Vector2d::Zero();
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    for (const Vector2d& point : points) {
      if (std::abs(normal.dot(point) - offset_m) < config.inlier_m) {
        ++count;
        sum += point;
        squares += point * point.transpose();
      }
    }
    if (count < config.min_points) {
      return std::nullopt;
    }
    const Vector2d mean = sum / count;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread(squares / count - mean * mean.transpose());
    const double length_m = std::sqrt(12.0 * std::max(0.0, spread.eigenvalues().y()));  // of an even spread
    normal = spread.eigenvectors().col(0);
    normal *= normal.y() < 0.0 ? -1.0 : 1.0;
    offset_m = normal.dot(mean);
    if (length_m < config.min_length_m) {
      return std::nullopt;
    }
  }
  double from_m = edge.length_m;
  double to_m = 0.0;
  for (const Vector2d& point : points) {
    if (std::abs(normal.dot(point) - offset_m) < config.inlier_m) {
      from_m = std::min(from_m, point.x());
      to_m = std::max(to_m, point.x());
    }
  }
  const Vector2d normal_map = normal.x() * edge.along + normal.y() * edge.normal;
  return WallLine{normal_map, offset_m + normal_map.dot(edge.from), from_m, to_m};
}

/// Along the true normal of wall `a`, from its middle to the line of `b`, both lines as given.
double distanceBetween(const Edge& a, const WallLine& line_a, const WallLine& line_b) {
  const auto reach = [&](const WallLine& line) { return (line.offset_m - line.normal.dot(a.middle())) / line.normal.dot(a.normal); };
  return std::abs(reach(line_b) - reach(line_a));
}

bool areOpposite(const Edge& a, const Edge& b, double inside_of_a) {
  constexpr double kParallel = 0.0872;  // sin 5 deg
  if (std::abs(crossOf(a.along, b.along)) > kParallel || a.along.dot(b.along) > 0.0) {
    return false;
  }
  const double first_m = (b.from - a.from).dot(a.along);
  const double last_m = first_m + b.length_m * b.along.dot(a.along);
  const bool is_side_by_side = std::min(std::max(first_m, last_m), a.length_m) - std::max(std::min(first_m, last_m), 0.0) > 0.1;
  return is_side_by_side && (b.middle() - a.middle()).dot(a.normal) * inside_of_a > 0.0;
}

WallLine lineOf(const Edge& edge) {
  return {edge.normal, edge.normal.dot(edge.from), 0.0, edge.length_m};
}

/// Where wall `a` ends and `b` begins.
std::optional<Vector2d> findCorner(const std::optional<WallLine>& a, const std::optional<WallLine>& b) {
  constexpr double kLeastTurn = 0.2;  // sine of the angle
  if (!a || !b || std::abs(crossOf(a->normal, b->normal)) < kLeastTurn) {
    return std::nullopt;
  }
  const double determinant = crossOf(a->normal, b->normal);
  return Vector2d((a->offset_m * b->normal.y() - b->offset_m * a->normal.y()) / determinant,
                  (a->normal.x() * b->offset_m - b->normal.x() * a->offset_m) / determinant);
}

}  // namespace

std::vector<std::string> RoomShapeConfig::validate() const {
  base::ConfigRules rules;
  rules.greater("search_m", search_m, 0.0).greater("inlier_m", inlier_m, 0.0).atLeast("from_end_m", from_end_m, 0.0);
  rules.atLeast("lowest_m", lowest_m, 0.0).greater("highest_m", highest_m, 0.0);
  rules.atLeast("min_points", min_points, 2).greater("min_length_m", min_length_m, 0.0).greater("to_corner_m", to_corner_m, 0.0);
  return rules.messages();
}

RoomShape measureRoom(const std::vector<Vector2d>& outline_map, const std::vector<Eigen::Vector3f>& points_map,
                      const RoomShapeConfig& config) {
  OIKOS_CHECK(outline_map.size() >= 3 && config.validate().empty());
  const std::size_t count = outline_map.size();
  double twice_area = 0.0;
  std::vector<Edge> edges;
  RoomShape shape;
  for (std::size_t i = 0; i < count; ++i) {
    edges.push_back(edgeOf(outline_map, i));
    twice_area += crossOf(outline_map[i], outline_map[(i + 1) % count]);
    shape.walls.push_back(fitWall(edges.back(), points_map, config));
  }
  std::vector<std::optional<Vector2d>> corners;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    const bool is_near = shape.walls[before] && shape.walls[before]->to_m > edges[before].length_m - config.to_corner_m && shape.walls[i] &&
                         shape.walls[i]->from_m < config.to_corner_m;
    corners.push_back(is_near ? findCorner(shape.walls[before], shape.walls[i]) : std::nullopt);
  }
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      if (shape.walls[a] && shape.walls[b] && areOpposite(edges[a], edges[b], twice_area)) {
        shape.between_walls.push_back({a, b, distanceBetween(edges[a], lineOf(edges[a]), lineOf(edges[b])),
                                       distanceBetween(edges[a], *shape.walls[a], *shape.walls[b])});
      }
      if (corners[a] && corners[b]) {
        shape.between_corners.push_back({a, b, (outline_map[a] - outline_map[b]).norm(), (*corners[a] - *corners[b]).norm()});
      }
    }
  }
  return shape;
}

}  // namespace oikos::metrics
