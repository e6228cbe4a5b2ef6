// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/model/assimp_scene.h"
#include "core/model/triangle_mesh.h"

struct aiMaterial;

namespace oikos::model {

/// What a screen shows (sRGB, 0 to 1) of linear light (IEC 61966-2-1); outside of 0 to 1 it is clipped, NaN is 0.
[[nodiscard]] float srgbOfLinear(float linear);

/// The materials of a scene as ours, made when a mesh asks for them: a texture that nothing wears is not missed.
class SceneMaterials {
 public:
  /// Keeps the references.
  SceneMaterials(const aiScene& scene, MeshFormat format, ModelFolder& folder) : scene_(scene), format_(format), folder_(folder) {}

  /// How a mesh wears a material; `index` counts in `materials()`, `uv_channel` in its mesh's texture coordinates.
  struct Worn {
    std::uint32_t index = 0;
    unsigned uv_channel = 0;
  };
  /// A material of our making that stands for "none given" is white on a mesh with colours of its own. Throws Error{kInput} for a texture
  /// that is missing, refused or no PNG or JPEG.
  [[nodiscard]] Worn wear(unsigned scene_index, bool has_vertex_colors);

  [[nodiscard]] const std::vector<Material>& materials() const { return materials_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  [[nodiscard]] Worn make(const aiMaterial& source, bool has_vertex_colors);
  [[nodiscard]] Eigen::Vector3f colorOf(const aiMaterial& source, bool is_white_by_default) const;
  [[nodiscard]] cv::Mat textureOf(const std::string& name, const std::string& material);

  const aiScene& scene_;
  MeshFormat format_;
  ModelFolder& folder_;
  std::map<std::pair<unsigned, bool>, Worn> worn_;
  std::map<std::string, cv::Mat> textures_;
  std::vector<Material> materials_;
  std::vector<std::string> warnings_;
};

}  // namespace oikos::model
