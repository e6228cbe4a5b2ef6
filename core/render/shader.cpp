// SPDX-License-Identifier: Apache-2.0
// Lambert's law for matt surfaces and a lobe about the mirrored direction for gloss (Blinn, "Models of Light Reflection for Computer
// Synthesized Pictures", SIGGRAPH 1977). Lamps throw shadows; the glow from all sides does not.
#include "core/render/shader.h"

#include <algorithm>
#include <cmath>

#include "core/render/texture.h"

namespace oikos::render {

namespace {

/// A shadow ray starts this far off the surface (m), or it would hit what it starts from.
constexpr float kShadowOffset_m = 2e-3F;
constexpr float kShinePower = 60.0F;

Eigen::Vector3f vertexColor(const model::TriangleMesh& mesh, const RayHit& hit) {
  const model::TriangleMesh::Triangle& corners = mesh.triangles[hit.triangle];
  const std::array<float, 3> weights = {1.0F - hit.u - hit.v, hit.u, hit.v};
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const geometry::Rgb& rgb = mesh.vertex_colors[corners[i]];
    color += weights[i] * Eigen::Vector3f(linearOf(rgb[0]), linearOf(rgb[1]), linearOf(rgb[2]));
  }
  return color;
}

Eigen::Vector2f textureCoordinate(const model::TriangleMesh& mesh, const RayHit& hit) {
  const model::TriangleMesh::Triangle& corners = mesh.triangles[hit.triangle];
  return (1.0F - hit.u - hit.v) * mesh.texture_coordinates[corners[0]] + hit.u * mesh.texture_coordinates[corners[1]] +
         hit.v * mesh.texture_coordinates[corners[2]];
}

/// Texture pixels along a metre of the triangle, in the mean over all directions.
float texelDensity(const model::TriangleMesh& mesh, std::uint32_t triangle, const TexturePyramid& texture) {
  const model::TriangleMesh::Triangle& corners = mesh.triangles[triangle];
  const Eigen::Vector2f first = mesh.texture_coordinates[corners[1]] - mesh.texture_coordinates[corners[0]];
  const Eigen::Vector2f second = mesh.texture_coordinates[corners[2]] - mesh.texture_coordinates[corners[0]];
  const float texels = std::abs(first.x() * second.y() - first.y() * second.x()) * texture.width() * texture.height();
  const auto area = static_cast<float>(mesh.areaNormal(triangle).norm());
  return std::sqrt(texels / std::max(area, 1e-12F));
}

}  // namespace

Shader::Shader(const Scene& scene, const CameraRays& rays, const ViewConfig& config)
    : parts_(scene.parts()), embree_(scene.embree()), config_(config), pixel_size_(static_cast<float>(rays.pixelSize())) {}

Eigen::Vector3f Shader::albedo(const SurfacePoint& surface) const {
  const ScenePart& part = parts_[static_cast<std::size_t>(surface.hit.part)];
  const model::TriangleMesh& mesh = *part.mesh_part;
  const SurfaceLook& look = lookAt(surface);
  Eigen::Vector3f color = look.color_rgb;
  if (!mesh.vertex_colors.empty()) {
    color = color.cwiseProduct(vertexColor(mesh, surface.hit));
  }
  if (look.texture && !mesh.texture_coordinates.empty()) {
    const float facing = std::max(0.1F, surface.normal_map.dot(surface.to_camera_map));
    const float footprint_m = surface.depth_m * pixel_size_ / std::sqrt(facing);
    const float footprint_px = footprint_m * texelDensity(mesh, surface.hit.triangle, *look.texture);
    color = color.cwiseProduct(look.texture->at(textureCoordinate(mesh, surface.hit), footprint_px));
  }
  return color;
}

void Shader::shade(const SurfacePacket& surfaces, ColorPacket& colors_rgb) const {
  ColorPacket light_rgb;
  ColorPacket shine_rgb;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const float up = 0.5F + 0.5F * surfaces[i].normal_map.z();
    light_rgb[i] = up * config_.lighting.from_above_rgb + (1.0F - up) * config_.lighting.from_below_rgb;
    shine_rgb[i].setZero();
  }
  for (const PointLight& lamp : config_.lighting.lamps) {
    addLamp(lamp, surfaces, light_rgb, shine_rgb);
  }
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    colors_rgb[i] = surfaces[i].hit.part < 0
                        ? config_.background_rgb
                        : Eigen::Vector3f(albedo(surfaces[i]).cwiseProduct(light_rgb[i]) + gloss(surfaces[i]) * shine_rgb[i]);
  }
}

void Shader::addLamp(const PointLight& lamp, const SurfacePacket& surfaces, ColorPacket& light_rgb, ColorPacket& shine_rgb) const {
  const Eigen::Vector3f lamp_map = lamp.position_map.cast<float>();
  RayPacket shadows;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    shadows.origin_map[i] = surfaces[i].point_map + kShadowOffset_m * surfaces[i].normal_map;
    shadows.direction_map[i] = lamp_map - shadows.origin_map[i];
    shadows.near[i] = 0.0F;
    shadows.far[i] = 0.98F;  // the lamp's own shade does not count
    shadows.valid[i] = surfaces[i].hit.part >= 0 && shadows.direction_map[i].dot(surfaces[i].normal_map) > 0.0F &&
                       shadows.direction_map[i].squaredNorm() < lamp.reach_m * lamp.reach_m;
  }
  if (std::find(shadows.valid.begin(), shadows.valid.end(), true) == shadows.valid.end()) {
    return;
  }
  const std::array<bool, kPacketSize> in_shadow =
      config_.lighting.has_shadows ? embree_.occluded(shadows) : std::array<bool, kPacketSize>{};
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    if (!shadows.valid[i] || in_shadow[i]) {
      continue;
    }
    const float distance_sq = std::max(0.01F, shadows.direction_map[i].squaredNorm());
    const Eigen::Vector3f to_lamp = shadows.direction_map[i] / std::sqrt(distance_sq);
    const float fading = 1.0F - distance_sq / (lamp.reach_m * lamp.reach_m);
    const Eigen::Vector3f brightness_rgb = lamp.intensity_rgb * (fading * fading / distance_sq);
    light_rgb[i] += brightness_rgb * to_lamp.dot(surfaces[i].normal_map);
    if (gloss(surfaces[i]) > 0.0F) {
      const float mirrored = std::max(0.0F, (to_lamp + surfaces[i].to_camera_map).normalized().dot(surfaces[i].normal_map));
      shine_rgb[i] += brightness_rgb * std::pow(mirrored, kShinePower);
    }
  }
}

}  // namespace oikos::render
