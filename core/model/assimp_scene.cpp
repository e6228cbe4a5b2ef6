// SPDX-License-Identifier: Apache-2.0
#include "core/model/assimp_scene.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/model/assimp_files.h"
#include "core/model/collada_check.h"
#include "core/model/nesting_check.h"

namespace oikos::model {

namespace {

using base::Error;
using base::ErrorCode;

struct KnownFormat {
  std::string_view ending;
  MeshFormat format;
  std::string_view importer;  ///< as Assimp 5.2 names it; none: not through Assimp
};
constexpr std::array<KnownFormat, 6> kFormats = {{{".obj", MeshFormat::kObj, "Wavefront Object Importer"},
                                                  {".gltf", MeshFormat::kGltf, "glTF2 Importer"},
                                                  {".glb", MeshFormat::kGltf, "glTF2 Importer"},
                                                  {".ply", MeshFormat::kPly, ""},
                                                  {".stl", MeshFormat::kStl, "Stereolithography (STL) Importer"},
                                                  {".dae", MeshFormat::kCollada, "Collada Importer"}}};

/// Assimp cuts a polygon in cubic time at worst.
constexpr unsigned kMaxPolygonCorners = 2000;
constexpr std::size_t kMaxNodes = 1'000'000;

std::string lowerCaseEnding(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

const KnownFormat& knownFormatOf(const std::filesystem::path& file) {
  const std::string ending = lowerCaseEnding(file);
  const auto* known = std::find_if(kFormats.begin(), kFormats.end(), [&](const KnownFormat& format) { return format.ending == ending; });
  if (known == kFormats.end()) {
    throw Error(ErrorCode::kInput, "is of no known format, by its name: must end in .obj, .gltf, .glb, .ply, .stl or .dae", file.string());
  }
  return *known;
}

void keepOneImporter(Assimp::Importer& importer, std::string_view name) {
  std::vector<Assimp::BaseImporter*> unwanted;
  for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
    if (importer.GetImporterInfo(i)->mName != name) {
      unwanted.push_back(importer.GetImporter(i));
    }
  }
  for (Assimp::BaseImporter* loader : unwanted) {
    importer.UnregisterLoader(loader);
    delete loader;  // unregistering hands it over
  }
  OIKOS_CHECK(importer.GetImporterCount() == 1);
}

class SceneCheck {
 public:
  SceneCheck(const aiScene& scene, std::string file, std::size_t max_triangles)
      : scene_(scene), file_(std::move(file)), max_triangles_(max_triangles) {}

  void run() {
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
      checkVertices(*scene_.mMeshes[i]);
      triangles_of_mesh_.push_back(checkFaces(*scene_.mMeshes[i]));
    }
    checkNodes();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorCode::kInput, what, file_); }

  void checkVertices(const aiMesh& mesh) const {
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& vertex = mesh.mVertices[i];
      if (!std::isfinite(vertex.x) || !std::isfinite(vertex.y) || !std::isfinite(vertex.z)) {
        fail("vertex " + std::to_string(i) + " of mesh '" + mesh.mName.C_Str() + "' is not finite");
      }
    }
    if (mesh.mMaterialIndex >= scene_.mNumMaterials) {
      fail("mesh '" + std::string(mesh.mName.C_Str()) + "' has a material that does not exist");
    }
  }

  [[nodiscard]] std::size_t checkFaces(const aiMesh& mesh) const {
    std::size_t triangles = 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices > kMaxPolygonCorners) {
        fail("a face has " + std::to_string(face.mNumIndices) + " corners: must be at most " + std::to_string(kMaxPolygonCorners));
      }
      if (std::any_of(face.mIndices, face.mIndices + face.mNumIndices, [&](unsigned index) { return index >= mesh.mNumVertices; })) {
        fail("face " + std::to_string(i) + " of mesh '" + mesh.mName.C_Str() + "' has a vertex that does not exist");
      }
      triangles += face.mNumIndices >= 3 ? face.mNumIndices - 2 : 0;
    }
    return triangles;
  }

  void checkNodes() const {
    std::vector<const aiNode*> open = {scene_.mRootNode};
    std::size_t triangles = 0;
    for (std::size_t nodes = 0; !open.empty(); ++nodes) {
      const aiNode& node = *open.back();
      open.pop_back();
      triangles += checkNode(node);
      open.insert(open.end(), node.mChildren, node.mChildren + node.mNumChildren);
      if (nodes > kMaxNodes || triangles > max_triangles_) {
        fail("is too large: must have at most " + std::to_string(max_triangles_) + " triangles and " + std::to_string(kMaxNodes) +
             " nodes");
      }
    }
  }

  [[nodiscard]] std::size_t checkNode(const aiNode& node) const {
    std::size_t triangles = 0;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      triangles += triangles_of_mesh_.at(node.mMeshes[i]);
    }
    for (unsigned row = 0; row < 4; ++row) {
      for (unsigned column = 0; column < 4; ++column) {
        if (!std::isfinite(node.mTransformation[row][column])) {
          fail("the transformation of node '" + std::string(node.mName.C_Str()) + "' is not finite");
        }
      }
    }
    return triangles;
  }

  const aiScene& scene_;
  std::string file_;
  std::size_t max_triangles_;
  std::vector<std::size_t> triangles_of_mesh_;
};

}  // namespace

MeshFormat meshFormatOf(const std::filesystem::path& file) {
  return knownFormatOf(file).format;
}

AssimpScene::AssimpScene(ModelFolder& folder, MeshFormat format, std::size_t max_triangles)
    : importer_(std::make_unique<Assimp::Importer>()) {
  const std::filesystem::path& file = folder.modelFile();
  OIKOS_CHECK(knownFormatOf(file).format == format && format != MeshFormat::kPly);
  if (format == MeshFormat::kCollada) {
    checkXmlNesting(*folder.modelBytes(), file.string());
    checkColladaAccessors(*folder.modelBytes(), file.string());
  } else if (format == MeshFormat::kGltf) {
    checkGltfNesting(*folder.modelBytes(), file.string());
  }
  const std::string model_name = file.stem().string() + lowerCaseEnding(file);
  AssimpFileLog log;
  keepOneImporter(*importer_, knownFormatOf(file).importer);
  importer_->SetIOHandler(makeAssimpFiles(folder, log, model_name).release());
  scene_ = importer_->ReadFile(model_name, 0);
  if (log.refusal) {
    std::rethrow_exception(log.refusal);
  }
  if (log.missing.size() > 1) {
    log.missing.erase("./" + file.stem().string() + ".mtl");  // which Assimp tries in place of a library that is missing
  }
  missing_files_.assign(log.missing.begin(), log.missing.end());
  if (scene_ == nullptr) {
    const std::string missing = missing_files_.empty() ? "" : "; missing file: " + folder.placeOf(missing_files_.front());
    throw Error(ErrorCode::kInput, "cannot be read: " + std::string(importer_->GetErrorString()) + missing, file.string());
  }
  SceneCheck(*scene_, file.string(), max_triangles).run();
  // Only now: sorting and cutting what is not finite is undefined.
  scene_ = importer_->ApplyPostProcessing(aiProcess_Triangulate);
  if (scene_ == nullptr) {
    throw Error(ErrorCode::kInput, "its polygons cannot be cut into triangles", file.string());
  }
  // What ours refers to ends here. Another takes its place, since a null pointer would leak it.
  importer_->SetIOHandler(new Assimp::DefaultIOSystem);
}

AssimpScene::~AssimpScene() = default;

}  // namespace oikos::model
