// SPDX-License-Identifier: Apache-2.0
// How a surface looks in the light. Included by this folder's sources only.
#pragma once

#include <array>

#include "core/render/ray_caster.h"

namespace oikos::render {

using ColorPacket = std::array<Eigen::Vector3f, kPacketSize>;

/// Immutable, so thread-safe while the scene is not changed.
class Shader {
 public:
  Shader(const Scene& scene, const CameraRays& rays, const ViewConfig& config);

  /// Linear RGB that comes to the camera; the background where nothing was hit.
  void shade(const SurfacePacket& surfaces, ColorPacket& colors_rgb) const;
  /// Linear RGB that the surface throws back of white light.
  [[nodiscard]] Eigen::Vector3f albedo(const SurfacePoint& surface) const;
  [[nodiscard]] float gloss(const SurfacePoint& surface) const { return lookAt(surface).gloss; }

 private:
  [[nodiscard]] const SurfaceLook& lookAt(const SurfacePoint& surface) const {
    return parts_[static_cast<std::size_t>(surface.hit.part)].lookOf(surface.hit.triangle);
  }
  void addLamp(const PointLight& lamp, const SurfacePacket& surfaces, ColorPacket& light_rgb, ColorPacket& shine_rgb) const;

  const std::vector<ScenePart>& parts_;
  const EmbreeScene& embree_;
  const ViewConfig& config_;
  float pixel_size_;
};

}  // namespace oikos::render
