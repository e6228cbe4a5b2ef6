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

/// What a ray has hit.
struct SurfacePoint {
  RayHit hit;
  float depth_m = 0.0F;
  Eigen::Vector3f point_map = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal_map = Eigen::Vector3f::Zero();     ///< of the surface as it looks, towards the camera
  Eigen::Vector3f to_camera_map = Eigen::Vector3f::Zero();  ///< length 1
};

using PixelPacket = std::array<PixelRay, kPacketSize>;
using SurfacePacket = std::array<SurfacePoint, kPacketSize>;

/// Immutable, so thread-safe while the scene is not changed.
class RayCaster {
 public:
  RayCaster(const Scene& scene, const CameraRays& rays, const Viewpoint& viewpoint, const ViewConfig& config);

  void cast(const PixelPacket& pixels, SurfacePacket& surfaces) const;
  [[nodiscard]] const Eigen::Isometry3d& T_map_camera(int v_px) const {
    return T_map_camera_rows_[T_map_camera_rows_.size() == 1 ? 0 : static_cast<std::size_t>(v_px)];
  }

 private:
  [[nodiscard]] SurfacePoint surfaceAt(const RayHit& hit, const Eigen::Vector3d& origin_map, const Eigen::Vector3d& direction_map) const;

  const std::vector<ScenePart>& parts_;
  const EmbreeScene& embree_;
  const CameraRays& rays_;
  float near_m_;
  float far_m_;
  std::vector<Eigen::Isometry3d> T_map_camera_rows_;  ///< one for all, or one a row
};

}  // namespace oikos::render
