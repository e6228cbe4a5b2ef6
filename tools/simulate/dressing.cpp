// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/dressing.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "core/camera/sensor/hash_noise.h"
#include "tools/simulate/shell.h"
#include "tools/simulate/textures.h"

namespace oikos::simulate {

namespace {

struct Dress {
  std::string_view type;      ///< of the piece; empty: any
  std::string_view material;  ///< empty: any
  std::optional<TextureKind> texture;
  float gloss;
  int size_px = 256;
};

/// The first that fits.
constexpr std::array kDresses = {
    Dress{"picture", "front", TextureKind::kPainting, 0.1F},
    Dress{"box", "", TextureKind::kPrint, 0.1F},
    Dress{"carton", "", TextureKind::kPrint, 0.15F},
    Dress{"tin", "label", TextureKind::kPrint, 0.2F},
    Dress{"bottle", "label", TextureKind::kPrint, 0.1F},
    Dress{"jar", "label", TextureKind::kPrint, 0.1F},
    Dress{"book", "pages", std::nullopt, 0.0F},
    Dress{"book", "", TextureKind::kPrint, 0.1F},
    Dress{"cup", "", std::nullopt, 0.25F},
    Dress{"bowl", "", std::nullopt, 0.25F},
    Dress{"plate", "", std::nullopt, 0.25F},
    Dress{"bottle", "", std::nullopt, 0.4F},
    Dress{"tin", "", std::nullopt, 0.5F},
    Dress{"jar", "", std::nullopt, 0.4F},
    Dress{"rug", "", TextureKind::kFabric, 0.0F, 512},
    Dress{"sofa", "foot", TextureKind::kWood, 0.1F},
    Dress{"sofa", "", TextureKind::kFabric, 0.0F},
    Dress{"bed", "frame", TextureKind::kWood, 0.1F},
    Dress{"bed", "", TextureKind::kFabric, 0.0F},
    Dress{"fridge", "front", TextureKind::kBrushedMetal, 0.25F},
    Dress{"fridge", "body", TextureKind::kBrushedMetal, 0.2F},
    Dress{"oven", "front", TextureKind::kBrushedMetal, 0.3F},
    Dress{"oven", "panel", TextureKind::kBrushedMetal, 0.3F},
    Dress{"oven", "hob", TextureKind::kStone, 0.6F},
    Dress{"dishwasher", "front", TextureKind::kBrushedMetal, 0.25F},
    Dress{"bathtub", "", std::nullopt, 0.3F},
    Dress{"toilet", "", std::nullopt, 0.3F},
    Dress{"washbasin", "", std::nullopt, 0.3F},
    Dress{"door", "handle", std::nullopt, 0.6F},
    Dress{"door", "", TextureKind::kPlaster, 0.1F},
    Dress{"", "glass", std::nullopt, 0.9F},
    Dress{"", "screen", std::nullopt, 0.8F},
    Dress{"", "handle", std::nullopt, 0.6F},
    Dress{"", "knob", std::nullopt, 0.2F},
    Dress{"", "metal", std::nullopt, 0.6F},
    Dress{"", "worktop", TextureKind::kStone, 0.2F},
    Dress{"", "shade", TextureKind::kFabric, 0.0F},
    Dress{"", "front", TextureKind::kWood, 0.1F},
    Dress{"", "top", TextureKind::kWood, 0.1F},
    Dress{"", "leg", TextureKind::kWood, 0.1F},
    Dress{"", "seat", TextureKind::kWood, 0.1F},
    Dress{"", "body", TextureKind::kWood, 0.05F},
    Dress{"", "shelf", TextureKind::kWood, 0.05F},
    Dress{"", "frame", TextureKind::kWood, 0.1F},
};

const Dress* findDress(std::string_view type, std::string_view material) {
  const auto found = std::find_if(kDresses.begin(), kDresses.end(), [&](const Dress& dress) {
    return (dress.type.empty() || dress.type == type) && (dress.material.empty() || dress.material == material);
  });
  return found == kDresses.end() ? nullptr : &*found;
}

void setTexture(model::Material& material, TextureKind kind, std::uint64_t seed, int size_px) {
  if (material.texture.empty()) {
    material.texture = makeTexture(kind, seed, size_px);
    if (kind == TextureKind::kPainting || kind == TextureKind::kPrint) {
      material.color_rgb.setOnes();  // these bring their own colours
    }
  }
}

bool isWet(const std::string& room_type) {
  return room_type == "kitchen" || room_type == "bathroom";
}

/// Paint and linoleum without a pattern: what a camera has the least to hold on to.
bool isBare(const std::string& room_type) {
  return room_type == "corridor";
}

/// A light colour of its own for each room.
Eigen::Vector3f wallColor(std::uint64_t seed) {
  const auto share = [&](std::uint64_t i) { return camera::toUniform(camera::mixBits(seed + i)); };
  return Eigen::Vector3f(0.80F, 0.78F, 0.72F) + 0.16F * Eigen::Vector3f(share(1), share(2), share(3));
}

}  // namespace

std::uint64_t hashOf(const std::string& name) {
  std::uint64_t hash = 0;
  for (const char letter : name) {
    hash = camera::mixBits(hash + static_cast<unsigned char>(letter) + 1);
  }
  return hash;
}

void dress(model::ArticulatedModel& piece, const std::string& type, std::uint64_t seed) {
  for (model::ModelPart& part : piece.parts) {
    if (!part.mesh_part) {
      continue;
    }
    auto dressed = std::make_shared<model::TriangleMesh>(*part.mesh_part);
    if (dressed->materials.empty()) {
      dressed->materials.emplace_back();
      dressed->materials.front().name = "body";
    }
    for (model::Material& material : dressed->materials) {
      const Dress* const chosen = findDress(type, material.name);
      if (chosen == nullptr) {
        continue;
      }
      material.gloss = chosen->gloss;
      if (chosen->texture && !dressed->texture_coordinates.empty()) {
        setTexture(material, *chosen->texture, camera::mixBits(seed + hashOf(material.name)), chosen->size_px);
      }
    }
    part.mesh_part = std::move(dressed);
  }
}

void dressShell(model::TriangleMesh& shell, const std::string& room_type, std::uint64_t seed) {
  constexpr auto kRepeat_m = static_cast<float>(kShellTexture_m);
  for (Eigen::Vector2f& coordinate : shell.texture_coordinates) {
    coordinate /= kRepeat_m;
  }
  const bool has_tiles = isWet(room_type);
  model::Material& floor = shell.materials[kFloorMaterial];
  floor.color_rgb = has_tiles ? Eigen::Vector3f(0.72F, 0.70F, 0.66F) : Eigen::Vector3f(0.70F, 0.52F, 0.36F);
  floor.gloss = 0.15F;
  model::Material& walls = shell.materials[kWallMaterial];
  walls.color_rgb = wallColor(seed);
  model::Material& ceiling = shell.materials[kCeilingMaterial];
  ceiling.color_rgb.setConstant(0.93F);
  shell.materials[kSkirtingMaterial].color_rgb = {0.88F, 0.87F, 0.84F};
  if (isBare(room_type)) {
    return;
  }
  setTexture(floor, has_tiles ? TextureKind::kTiles : TextureKind::kPlanks, camera::mixBits(seed + 1), 2048);
  const bool is_papered = !has_tiles;
  setTexture(walls, is_papered ? TextureKind::kWallpaper : TextureKind::kPlaster, camera::mixBits(seed + 3), 2048);
  setTexture(ceiling, TextureKind::kPlaster, camera::mixBits(seed + 4), 512);
}

}  // namespace oikos::simulate
