// SPDX-License-Identifier: Apache-2.0
#include "core/model/scene_mesh.h"

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

namespace oikos::model {

namespace {

/// Assimp's row by row; may scale, shear and mirror.
Eigen::Affine3d toAffine(const aiMatrix4x4& T) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      result(row, column) = static_cast<double>(T[row][column]);
    }
  }
  return result;
}

/// glTF has y up; Assimp turns COLLADA to y up whatever its up_axis, in the root node. x stays, y becomes z, z becomes -y.
Eigen::Affine3d T_model_scene(MeshFormat format) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  if (format == MeshFormat::kGltf || format == MeshFormat::kCollada) {
    T.linear() << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  }
  return T;
}

std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0F * (std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : 0.0F)));
}

class SceneGatherer {
 public:
  SceneGatherer(const aiScene& scene, MeshFormat format, SceneMaterials& materials, std::vector<std::string>& warnings)
      : scene_(scene), format_(format), materials_(materials), warnings_(warnings) {}

  TriangleMesh run() {
    struct Open {
      const aiNode* node;
      Eigen::Affine3d T_model_parent;
    };
    std::vector<Open> open = {{scene_.mRootNode, T_model_scene(format_)}};
    while (!open.empty()) {
      const auto [node, T_model_parent] = open.back();
      open.pop_back();
      const Eigen::Affine3d T_model_node = T_model_parent * toAffine(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        add(*scene_.mMeshes[node->mMeshes[i]], T_model_node);
      }
      for (unsigned i = node->mNumChildren; i-- > 0;) {
        open.push_back({node->mChildren[i], T_model_node});
      }
    }
    // append() gives every piece materials of its own; ours are shared.
    gathered_.materials = materials_.materials();
    gathered_.triangle_materials = triangle_materials_;
    return std::move(gathered_);
  }

 private:
  void add(const aiMesh& mesh, const Eigen::Affine3d& T_model_mesh) {
    TriangleMesh piece = placed(mesh, T_model_mesh);
    addTriangles(piece, mesh, T_model_mesh.linear().determinant() < 0.0);
    if (piece.empty()) {
      return;
    }
    addColors(piece, mesh);
    const SceneMaterials::Worn worn = materials_.wear(mesh.mMaterialIndex, mesh.HasVertexColors(0));
    addTextureCoordinates(piece, mesh, worn);
    triangle_materials_.insert(triangle_materials_.end(), piece.triangles.size(), worn.index);
    append(gathered_, piece, Eigen::Isometry3d::Identity());
  }

  [[nodiscard]] TriangleMesh placed(const aiMesh& mesh, const Eigen::Affine3d& T_model_mesh) {
    TriangleMesh piece;
    piece.vertices.reserve(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& vertex = mesh.mVertices[i];
      piece.vertices.push_back((T_model_mesh * Eigen::Vector3d(vertex.x, vertex.y, vertex.z)).cast<float>());
    }
    // STL's normals are those of its triangles, and often zero.
    if (!mesh.HasNormals() || format_ == MeshFormat::kStl) {
      return piece;
    }
    const Eigen::Matrix3d for_normals = T_model_mesh.linear().inverse().transpose();
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& normal = mesh.mNormals[i];
      const Eigen::Vector3d turned = for_normals * Eigen::Vector3d(normal.x, normal.y, normal.z);
      piece.normals.push_back(turned.normalized().cast<float>());
      if (!turned.allFinite() || std::fabs(piece.normals.back().norm() - 1.0F) > 1e-3F) {
        warnings_.push_back("mesh '" + std::string(mesh.mName.C_Str()) +
                            "' has normals without a direction: its triangles are taken as flat");
        piece.normals.clear();
        break;
      }
    }
    return piece;
  }

  static void addTriangles(TriangleMesh& piece, const aiMesh& mesh, bool is_mirrored) {
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) {
        continue;  // a point or a line
      }
      piece.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
      if (is_mirrored) {
        std::swap(piece.triangles.back()[1], piece.triangles.back()[2]);
      }
    }
  }

  void addColors(TriangleMesh& piece, const aiMesh& mesh) const {
    const bool is_linear = format_ == MeshFormat::kGltf;
    for (unsigned i = 0; mesh.HasVertexColors(0) && i < mesh.mNumVertices; ++i) {
      const aiColor4D& color = mesh.mColors[0][i];
      geometry::Rgb& rgb = piece.vertex_colors.emplace_back();
      for (unsigned channel = 0; channel < 3; ++channel) {
        rgb[channel] = toByte(is_linear ? srgbOfLinear(color[channel]) : color[channel]);
      }
    }
  }

  void addTextureCoordinates(TriangleMesh& piece, const aiMesh& mesh, const SceneMaterials::Worn& worn) {
    const bool has_texture = !materials_.materials()[worn.index].texture.empty();
    if (worn.uv_channel >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !mesh.HasTextureCoords(worn.uv_channel)) {
      if (has_texture) {
        warnings_.push_back("mesh '" + std::string(mesh.mName.C_Str()) + "' has a texture but no texture coordinates for it");
      }
      return;
    }
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& coordinate = mesh.mTextureCoords[worn.uv_channel][i];
      piece.texture_coordinates.emplace_back(coordinate.x, coordinate.y);
    }
  }

  const aiScene& scene_;
  MeshFormat format_;
  SceneMaterials& materials_;
  std::vector<std::string>& warnings_;
  TriangleMesh gathered_;
  std::vector<std::uint32_t> triangle_materials_;
};

}  // namespace

TriangleMesh gatherScene(const aiScene& scene, MeshFormat format, SceneMaterials& materials, std::vector<std::string>& warnings) {
  return SceneGatherer(scene, format, materials, warnings).run();
}

}  // namespace oikos::model
