// SPDX-License-Identifier: Apache-2.0
#include "core/model/scene_materials.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/texture.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/geometry/tone_curve.h"
#include "core/recording/image_codec.h"

namespace oikos::model {

namespace {

struct TextureUse {
  std::string name;
  unsigned uv_channel = 0;
  bool is_transformed = false;
};

std::optional<TextureUse> findTexture(const aiMaterial& material) {
  for (const aiTextureType type : {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR}) {
    aiString path;
    if (material.GetTexture(type, 0, &path) == aiReturn_SUCCESS && path.length > 0) {
      TextureUse use;
      use.name = std::string(path.data, path.length);
      int channel = 0;
      if (material.Get(AI_MATKEY_UVWSRC(type, 0), channel) == aiReturn_SUCCESS && channel >= 0) {
        use.uv_channel = static_cast<unsigned>(channel);
      }
      aiUVTransform transform;
      use.is_transformed = material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS;
      return use;
    }
  }
  return std::nullopt;
}

std::string nameOf(const aiMaterial& material) {
  aiString name;
  return material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS ? std::string(name.C_Str()) : std::string();
}

float clipped(float value) {
  return std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : 0.0F;
}

}  // namespace

float srgbOfLinear(float linear) {
  return geometry::srgbOfLight(clipped(linear));
}

SceneMaterials::Worn SceneMaterials::wear(unsigned scene_index, bool has_vertex_colors) {
  const auto [entry, is_new] = worn_.try_emplace({scene_index, has_vertex_colors});
  if (is_new) {
    entry->second = make(*scene_.mMaterials[scene_index], has_vertex_colors);
  }
  return entry->second;
}

SceneMaterials::Worn SceneMaterials::make(const aiMaterial& source, bool has_vertex_colors) {
  Material material;
  material.name = nameOf(source);
  Worn worn;
  worn.index = static_cast<std::uint32_t>(materials_.size());
  const auto texture = findTexture(source);
  if (texture) {
    material.texture = textureOf(texture->name, material.name);
    worn.uv_channel = texture->uv_channel;
    if (texture->is_transformed) {
      warnings_.push_back("material '" + material.name + "' moves, turns or scales its texture: this is left out");
    }
  }
  // STL has no materials: Assimp's stands for none, as its default does in the other formats.
  if (format_ == MeshFormat::kStl || material.name == AI_DEFAULT_MATERIAL_NAME) {
    material.name.clear();
    material.color_rgb = texture || has_vertex_colors ? Eigen::Vector3f::Ones() : Material{}.color_rgb;
  } else {
    // In COLLADA a surface has a texture instead of a colour; what Assimp gives as its colour is of its own making.
    material.color_rgb = texture && format_ == MeshFormat::kCollada ? Eigen::Vector3f::Ones() : colorOf(source, texture.has_value());
  }
  materials_.push_back(std::move(material));
  return worn;
}

Eigen::Vector3f SceneMaterials::colorOf(const aiMaterial& source, bool is_white_by_default) const {
  aiColor4D color;
  if (source.Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS && source.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS) {
    return is_white_by_default ? Eigen::Vector3f::Ones() : Material{}.color_rgb;
  }
  if (format_ == MeshFormat::kGltf) {
    return {srgbOfLinear(color.r), srgbOfLinear(color.g), srgbOfLinear(color.b)};
  }
  return {clipped(color.r), clipped(color.g), clipped(color.b)};
}

cv::Mat SceneMaterials::textureOf(const std::string& name, const std::string& material) {
  const auto [entry, is_new] = textures_.try_emplace(name);
  if (!is_new) {
    return entry->second;
  }
  const std::string model = folder_.modelFile().string();
  const auto fail = [&](const std::string& reason) {
    throw base::Error(base::ErrorCode::kInput, "texture '" + name + "' of material '" + material + "' " + reason, model);
  };
  const std::string where = model + ": texture '" + name + "' of material '" + material + "'";
  if (name.starts_with('*')) {
    const aiTexture* embedded = scene_.GetEmbeddedTexture(name.c_str());
    if (embedded == nullptr || embedded->mHeight != 0) {
      fail("is not in the file as a PNG or JPEG");
    }
    entry->second = recording::decodeColorImage({reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth}, where);
    return entry->second;
  }
  const auto file = folder_.findFile(name);
  if (!file) {
    fail("is missing; looked for " + folder_.placeOf(name));
  }
  entry->second = recording::decodeColorImage(folder_.read(*file), where);
  return entry->second;
}

}  // namespace oikos::model
