// SPDX-License-Identifier: Apache-2.0
// Where the rays of pixels end. Included by this folder's sources only.
#pragma once

#include <array>
#include <vector>

#include "core/render/embree_scene.h"
#include "core/render/view.h"

namespace oikos::render {

struct PixelRay {
  int u_px = -1;  ///< -1: no ray
  int v_px = -1;
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();
};

using PixelPacket = std::array<PixelRay, kPacketSize>;

/// What eight rays have hit. Of a lane that has hit nothing only `part` and the normal, which is 0, mean anything.
struct alignas(32) SurfacePacket {
  HitPacket hit;
  Lanes<float> depth_m;
  Lanes<float> x, y, z;                                ///< of the point, map
  Lanes<float> normal_x, normal_y, normal_z;           ///< of the surface as it looks, towards the camera; map, length 1
  Lanes<float> to_camera_x, to_camera_y, to_camera_z;  ///< map, length 1
};

/// Immutable, so thread-safe while the scene is not changed.
class RayCaster {
 public:
  RayCaster(const Scene& scene, const CameraRays& rays, const Viewpoint& viewpoint, const ViewConfig& config);

  void cast(const PixelPacket& pixels, SurfacePacket& surfaces) const;
  [[nodiscard]] const Eigen::Isometry3d& T_map_camera(int v_px) const {
    return T_map_camera_rows_[T_map_camera_rows_.size() == 1 ? 0 : static_cast<std::size_t>(v_px)];
  }

 private:
  /// Rays in double precision: from `origin` along `direction`; map.
  struct alignas(32) Rays {
    Lanes<double> origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
  };
  /// The planes that the rays have hit: normal · point = offset; map.
  struct alignas(32) Planes {
    Lanes<double> normal_x, normal_y, normal_z, offset_m;
  };
  void aim(const PixelPacket& pixels, Rays& rays, RayPacket& packet) const;
  void findPlanes(const Rays& rays, SurfacePacket& surfaces, Planes& planes) const;

  const std::vector<ScenePart>& parts_;
  const EmbreeScene& embree_;
  const CameraRays& rays_;
  float near_m_;
  float far_m_;
  std::vector<Eigen::Isometry3d> T_map_camera_rows_;  ///< one for all, or one a row
};

}  // namespace oikos::render
