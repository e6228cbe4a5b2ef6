// SPDX-License-Identifier: Apache-2.0
// How a surface looks in the light. Included by this folder's sources only.
#pragma once

#include "core/render/ray_caster.h"

namespace oikos::render {

/// Of each lane; linear.
struct alignas(32) ColorPacket {
  Lanes<float> r, g, b;
};

/// Immutable, so thread-safe while the scene is not changed.
class Shader {
 public:
  Shader(const Scene& scene, const CameraRays& rays, const ViewConfig& config);

  /// What the surfaces throw back of white light, and how much they mirror; 0 where nothing was hit.
  void findLooks(const SurfacePacket& surfaces, ColorPacket& albedo_rgb, Lanes<float>& gloss) const;
  /// Light from all sides, and what comes to the camera of it; the background where nothing was hit.
  struct alignas(32) Shading {
    ColorPacket albedo_rgb;
    ColorPacket light_rgb;
    ColorPacket shine_rgb;
    Lanes<float> gloss;
  };
  void begin(const SurfacePacket& surfaces, Shading& shading) const;
  /// The light of a lamp on the lanes that it shines on: a bit each.
  void addLamp(const PointLight& lamp, const SurfacePacket& surfaces, std::uint8_t lit, Shading& shading) const;
  void finish(const SurfacePacket& surfaces, const Shading& shading, ColorPacket& colors_rgb) const;

 private:
  const std::vector<ScenePart>& parts_;
  const ViewConfig& config_;
  float pixel_size_;
};

}  // namespace oikos::render
