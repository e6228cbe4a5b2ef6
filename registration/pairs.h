// SPDX-License-Identifier: Apache-2.0
// Which point of the model is which point of the scan.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "core/render/view.h"
#include "registration/scan.h"

namespace oikos::registration {

enum class Association {
  kProjective,  ///< model and scan in the same pixel: no search
  kNearest,     ///< the nearest rendered point of each scan point, by k-d tree (S214)
};
constexpr auto enumTable(Association) {
  return std::to_array<base::EnumName<Association>>({{Association::kProjective, "projective"}, {Association::kNearest, "nearest"}});
}

/// A scan point before a plane of the model; the residual is normal_map · (scan_map - model_map): positive in front of the surface.
struct Pair {
  Eigen::Vector3d model_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_map = Eigen::Vector3d::Zero();  ///< of the model, towards the camera
  Eigen::Vector3d scan_map = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;  ///< of the residual, from the depth reading alone
  int part = -1;         ///< index into Scene::parts()
  bool is_edge = false;  ///< of an outline: the normal is across it, not the surface's

  [[nodiscard]] double residual_m() const { return normal_map.dot(scan_map - model_map); }
};

/// What became of the pixels that the model covers.
struct PairCounts {
  int model = 0;         ///< all of them
  int unread = 0;        ///< no depth there, or seen at a grazing angle
  int occluded = 0;      ///< something stands in front
  int seen_through = 0;  ///< the scan goes on behind the surface: the model is not there
  int turned = 0;        ///< it is as near, but faces another way
};

struct Pairing {
  std::vector<Pair> pairs;
  PairCounts counts;
};

struct PairRules {
  double gate_m = 0.05;          ///< a greater distance from the plane is no pair
  double min_normal_cos = 0.76;  ///< between the model's normal and the scan's
};

/// `view`: the model from `T_map_camera` in the pixels of scan.camera, with normals and parts.
[[nodiscard]] Pairing projectivePairs(const render::View& view, const Scan& scan, const Eigen::Isometry3d& T_map_camera,
                                      const PairRules& rules);
/// The same from the nearest point in space. Pixels are counted as above.
[[nodiscard]] Pairing nearestPairs(const render::View& view, const Scan& scan, const Eigen::Isometry3d& T_map_camera,
                                   const PairRules& rules);

/// Standard deviation of the distance of a depth reading from a plane that the ray meets with n · ray (ray with z = 1).
[[nodiscard]] double residualSigma_m(double depth_m, double normal_dot_ray);

}  // namespace oikos::registration
