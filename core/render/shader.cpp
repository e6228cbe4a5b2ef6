// SPDX-License-Identifier: Apache-2.0
// Lambert's law for matt surfaces and a lobe about the mirrored direction for gloss (Blinn, "Models of Light Reflection for Computer
// Synthesized Pictures", SIGGRAPH 1977). Lamps throw shadows; the glow from all sides does not.
#include "core/render/shader.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/tone_curve.h"
#include "core/render/surface_table.h"
#include "core/render/texture.h"

namespace oikos::render {

namespace {

Eigen::Array3f vertexColor(const model::TriangleMesh& mesh, const HitPacket& hit, std::size_t i) {
  const geometry::ToneCurve& curve = geometry::ToneCurve::instance();
  const model::TriangleMesh::Triangle& corners = mesh.triangles[hit.triangle[i]];
  const std::array<float, 3> weights = {1.0F - hit.u[i] - hit.v[i], hit.u[i], hit.v[i]};
  Eigen::Array3f color = Eigen::Array3f::Zero();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const geometry::Rgb& rgb = mesh.vertex_colors[corners[corner]];
    color += weights[corner] * Eigen::Array3f(curve.toLight(rgb[0]), curve.toLight(rgb[1]), curve.toLight(rgb[2]));
  }
  return color;
}

/// x^60, as Blinn's lobe.
float lobe(float x) {
  const float x4 = x * x * x * x;
  const float x16 = x4 * x4 * x4 * x4;
  return x16 * x16 * x16 * x4 * x4 * x4;
}

}  // namespace

Shader::Shader(const Scene& scene, const CameraRays& rays, const ViewConfig& config)
    : parts_(scene.parts()), config_(config), pixel_size_(static_cast<float>(rays.pixelSize())) {}

void Shader::findLooks(const SurfacePacket& surfaces, ColorPacket& albedo_rgb, Lanes<float>& gloss) const {
  Lanes<float> footprint_m;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const float facing = surfaces.normal_x[i] * surfaces.to_camera_x[i] + surfaces.normal_y[i] * surfaces.to_camera_y[i] +
                         surfaces.normal_z[i] * surfaces.to_camera_z[i];
    footprint_m[i] = surfaces.depth_m[i] * pixel_size_ / std::sqrt(facing > 0.1F ? facing : 0.1F);
  }
  const HitPacket& hit = surfaces.hit;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    Eigen::Array3f color = Eigen::Array3f::Zero();
    gloss[i] = 0.0F;
    if (hit.part[i] >= 0) {
      const ScenePart& part = parts_[static_cast<std::size_t>(hit.part[i])];
      const SurfaceTriangle& surface = (*part.surfaces)[hit.triangle[i]];
      const SurfaceLook& look = part.looks[surface.material];
      color = look.color_rgb;
      gloss[i] = look.gloss;
      if (surface.texels_per_m > 0.0F) {
        const Eigen::Vector2f coordinate = surface.texture_origin + hit.u[i] * surface.texture_along_u + hit.v[i] * surface.texture_along_v;
        color *= look.texture->at(coordinate, footprint_m[i] * surface.texels_per_m);
      }
      if (!part.mesh_part->vertex_colors.empty()) {
        color *= vertexColor(*part.mesh_part, hit, i);
      }
    }
    albedo_rgb.r[i] = color.x();
    albedo_rgb.g[i] = color.y();
    albedo_rgb.b[i] = color.z();
  }
}

void Shader::begin(const SurfacePacket& surfaces, Shading& shading) const {
  findLooks(surfaces, shading.albedo_rgb, shading.gloss);
  const Eigen::Vector3f& above = config_.lighting.from_above_rgb;
  const Eigen::Vector3f& below = config_.lighting.from_below_rgb;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const float up = 0.5F + 0.5F * surfaces.normal_z[i];
    shading.light_rgb.r[i] = below.x() + up * (above.x() - below.x());
    shading.light_rgb.g[i] = below.y() + up * (above.y() - below.y());
    shading.light_rgb.b[i] = below.z() + up * (above.z() - below.z());
  }
  shading.shine_rgb = {};
}

void Shader::addLamp(const PointLight& lamp, const SurfacePacket& surfaces, std::uint8_t lit, Shading& shading) const {
  if (lit == 0) {
    return;
  }
  const Eigen::Vector3f at = lamp.position_map.cast<float>();
  const float per_reach_sq = 1.0F / (lamp.reach_m * lamp.reach_m);
  const bool shines = std::any_of(shading.gloss.begin(), shading.gloss.end(), [](float gloss) { return gloss > 0.0F; });
  Lanes<float> diffuse;
  Lanes<float> mirrored{};
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const float x = at.x() - surfaces.x[i];
    const float y = at.y() - surfaces.y[i];
    const float z = at.z() - surfaces.z[i];
    const float measured_sq = x * x + y * y + z * z;
    const float distance_sq = measured_sq > 0.01F ? measured_sq : 0.01F;
    const float per_distance = 1.0F / std::sqrt(distance_sq);
    const float along = x * surfaces.normal_x[i] + y * surfaces.normal_y[i] + z * surfaces.normal_z[i];
    const float fading = 1.0F - distance_sq * per_reach_sq;
    const bool is_lit = (static_cast<unsigned>(lit) >> i & 1U) != 0;
    const float brightness = (is_lit & (along > 0.0F) & (fading > 0.0F)) ? fading * fading / distance_sq : 0.0F;
    diffuse[i] = brightness * along * per_distance;
    if (shines) {
      const float half_x = x * per_distance + surfaces.to_camera_x[i];
      const float half_y = y * per_distance + surfaces.to_camera_y[i];
      const float half_z = z * per_distance + surfaces.to_camera_z[i];
      const float cosine = (half_x * surfaces.normal_x[i] + half_y * surfaces.normal_y[i] + half_z * surfaces.normal_z[i]) /
                           std::sqrt(half_x * half_x + half_y * half_y + half_z * half_z + 1e-12F);
      mirrored[i] = brightness * lobe(cosine > 0.0F ? cosine : 0.0F);
    }
  }
  const auto add = [&](const Lanes<float>& amount, ColorPacket& rgb) {
    for (std::size_t i = 0; i < kPacketSize; ++i) {
      rgb.r[i] += lamp.intensity_rgb.x() * amount[i];
      rgb.g[i] += lamp.intensity_rgb.y() * amount[i];
      rgb.b[i] += lamp.intensity_rgb.z() * amount[i];
    }
  };
  add(diffuse, shading.light_rgb);
  if (shines) {
    add(mirrored, shading.shine_rgb);
  }
}

void Shader::finish(const SurfacePacket& surfaces, const Shading& shading, ColorPacket& colors_rgb) const {
  const Eigen::Vector3f& background = config_.background_rgb;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const bool is_hit = surfaces.hit.part[i] >= 0;
    const float gloss = shading.gloss[i];
    const auto color = [&](float albedo, float light, float shine, float otherwise) {
      return is_hit ? albedo * light + gloss * shine : otherwise;
    };
    colors_rgb.r[i] = color(shading.albedo_rgb.r[i], shading.light_rgb.r[i], shading.shine_rgb.r[i], background.x());
    colors_rgb.g[i] = color(shading.albedo_rgb.g[i], shading.light_rgb.g[i], shading.shine_rgb.g[i], background.y());
    colors_rgb.b[i] = color(shading.albedo_rgb.b[i], shading.light_rgb.b[i], shading.shine_rgb.b[i], background.z());
  }
}

}  // namespace oikos::render
