// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/model/model_folder.h"

struct aiScene;
namespace Assimp {
class Importer;
}

namespace oikos::model {

enum class MeshFormat { kObj, kGltf, kPly, kStl, kCollada };

/// By the name's ending, in any case. Throws Error{kInput} with the known ones.
[[nodiscard]] MeshFormat meshFormatOf(const std::filesystem::path& file);

/// A scene as Assimp reads it, checked: its indices, vertices and transformations can be trusted, its faces have at most three corners.
class AssimpScene {
 public:
  /// Only the importer of the format is used, and only through the folder. Throws Error{kInput} as readMesh does.
  AssimpScene(ModelFolder& folder, MeshFormat format, std::size_t max_triangles);
  ~AssimpScene();
  AssimpScene(const AssimpScene&) = delete;
  AssimpScene& operator=(const AssimpScene&) = delete;

  [[nodiscard]] const aiScene& scene() const { return *scene_; }
  /// Names of files, other than textures, that the model asked for in vain.
  [[nodiscard]] const std::vector<std::string>& missingFiles() const { return missing_files_; }

 private:
  std::unique_ptr<Assimp::Importer> importer_;
  const aiScene* scene_ = nullptr;  ///< the importer's
  std::vector<std::string> missing_files_;
};

}  // namespace oikos::model
