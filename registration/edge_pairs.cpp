// SPDX-License-Identifier: Apache-2.0
#include "registration/edge_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

namespace oikos::registration {

namespace {

constexpr float kJump_m = 0.08F;    ///< a smaller step in depth is no outline
constexpr int kShadowWidth_px = 6;  ///< beside an edge a projector's shadow may leave so many pixels without a reading
constexpr double kAcross = 0.7;     ///< of the outline's normal that must lie along a row or column to search there

struct Direction {
  ScanEdges::Side side;
  int du;
  int dv;
};
constexpr std::array<Direction, 4> kDirections = {
    {{ScanEdges::kLeft, -1, 0}, {ScanEdges::kRight, 1, 0}, {ScanEdges::kAbove, 0, -1}, {ScanEdges::kBelow, 0, 1}}};

bool contains(const camera::PinholeCamera& camera, int u, int v) {
  return u >= 0 && v >= 0 && u < camera.width && v < camera.height;
}

/// Whether what the scan has beyond a reading, past a shadow if there is one, is clearly farther away.
bool fallsOff(const Scan& scan, int u, int v, const Direction& direction) {
  const float near_m = scan.at(u, v).point_camera.z();
  for (int i = 1; i <= kShadowWidth_px; ++i) {
    const int x = u + i * direction.du;
    const int y = v + i * direction.dv;
    if (!contains(scan.camera, x, y)) {
      return false;
    }
    const float beyond_m = scan.at(x, y).point_camera.z();
    if (beyond_m > 0.0F) {
      return beyond_m - near_m > kJump_m * static_cast<float>(i == 1 ? 1.0 : 1.5);
    }
  }
  return false;
}

class Outline {
 public:
  Outline(const render::View& view, const Scan& scan, const ScanEdges& edges, double gate_m)
      : view_(view), scan_(scan), edges_(edges), gate_m_(gate_m) {}

  [[nodiscard]] bool isAt(int u, int v, const Direction& direction) const {
    const int x = u + direction.du;
    const int y = v + direction.dv;
    return contains(scan_.camera, x, y) && !isInFront(x, y, view_.depth_m.at<float>(v, u));
  }

  /// Outwards, in the image; length 1. From the share of the surroundings that the model covers.
  [[nodiscard]] Eigen::Vector2d normalAt(int u, int v) const {
    constexpr int kRadius_px = 3;
    const float depth_m = view_.depth_m.at<float>(v, u);
    Eigen::Vector2d inwards = Eigen::Vector2d::Zero();
    for (int dv = -kRadius_px; dv <= kRadius_px; ++dv) {
      for (int du = -kRadius_px; du <= kRadius_px; ++du) {
        if (contains(scan_.camera, u + du, v + dv) && isInFront(u + du, v + dv, depth_m)) {
          inwards += Eigen::Vector2d(du, dv);
        }
      }
    }
    return -inwards.normalized();
  }

  /// How many pixels farther out (or in, if negative) the scan's jump is.
  [[nodiscard]] std::optional<int> findJump(int u, int v, const Direction& direction) const {
    const double depth_m = static_cast<double>(view_.depth_m.at<float>(v, u));
    const int reach = std::max(1, static_cast<int>(gate_m_ * scan_.camera.fx / depth_m));
    for (int i = 0; i <= 2 * reach; ++i) {
      const int offset = i % 2 == 0 ? i / 2 : -(i + 1) / 2;
      const int x = u + offset * direction.du;
      const int y = v + offset * direction.dv;
      if (contains(scan_.camera, x, y) && (edges_.at(x, y) & direction.side) != 0 &&
          std::abs(static_cast<double>(scan_.at(x, y).point_camera.z()) - depth_m) < gate_m_) {
        return offset;
      }
    }
    return std::nullopt;
  }

 private:
  /// Whether the model covers a pixel, not clearly behind `depth_m`.
  [[nodiscard]] bool isInFront(int u, int v, float depth_m) const {
    return view_.part.at<int>(v, u) >= 0 && view_.depth_m.at<float>(v, u) - depth_m < kJump_m;
  }

  const render::View& view_;
  const Scan& scan_;
  const ScanEdges& edges_;
  double gate_m_;
};

/// Across the outline and across the line of sight, in the camera's frame.
Eigen::Vector3d acrossOutline(const camera::PinholeCamera& camera, int u, int v, const Eigen::Vector2d& normal_px) {
  const Eigen::Vector3d tangent(-normal_px.y() / camera.fx, normal_px.x() / camera.fy, 0.0);
  const Eigen::Vector3d across = tangent.cross(camera.ray(u, v)).normalized();
  const Eigen::Vector3d outwards(normal_px.x(), normal_px.y(), 0.0);
  return across.dot(outwards) >= 0.0 ? across : Eigen::Vector3d(-across);
}

}  // namespace

ScanEdges::ScanEdges(const Scan& scan) : width_(scan.camera.width), sides_(scan.points.size(), 0) {
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      if (scan.at(u, v).point_camera.z() <= 0.0F) {
        continue;
      }
      unsigned sides = 0;
      for (const Direction& direction : kDirections) {
        sides |= fallsOff(scan, u, v, direction) ? static_cast<unsigned>(direction.side) : 0U;
      }
      sides_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)] =
          static_cast<unsigned char>(sides);
    }
  }
}

int appendEdgePairs(const render::View& view, const Scan& scan, const ScanEdges& edges, const Eigen::Isometry3d& T_map_camera,
                    double gate_m, std::vector<Pair>& pairs) {
  const Outline outline(view, scan, edges, gate_m);
  int places = 0;
  for (int v = 0; v < scan.camera.height; ++v) {
    const auto* parts = view.part.ptr<int>(v);
    for (int u = 0; u < scan.camera.width; ++u) {
      if (parts[u] < 0) {
        continue;
      }
      for (const Direction& direction : kDirections) {
        if (!outline.isAt(u, v, direction)) {
          continue;
        }
        const Eigen::Vector2d normal_px = outline.normalAt(u, v);
        if (normal_px.x() * direction.du + normal_px.y() * direction.dv < kAcross) {
          continue;
        }
        ++places;
        if (const auto offset = outline.findJump(u, v, direction)) {
          const double depth_m = static_cast<double>(view.depth_m.at<float>(v, u));
          const Eigen::Vector3d jump = depth_m * scan.camera.ray(u + *offset * direction.du, v + *offset * direction.dv);
          pairs.push_back({T_map_camera * (depth_m * scan.camera.ray(u, v)),
                           T_map_camera.linear() * acrossOutline(scan.camera, u, v, normal_px), T_map_camera * jump,
                           0.5 * depth_m / scan.camera.fx, parts[u], true});
        }
      }
    }
  }
  return places;
}

}  // namespace oikos::registration
