// SPDX-License-Identifier: Apache-2.0
#include "core/model/mesh_file.h"

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/geometry/ply.h"
#include "core/model/assimp_scene.h"
#include "core/model/mesh_weld.h"
#include "core/model/scene_materials.h"
#include "core/model/scene_mesh.h"

namespace oikos::model {

namespace {

constexpr float kLargestFurniture_m = 20.0F;
constexpr float kSmallestThing_m = 0.001F;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw base::Error(base::ErrorCode::kInput, what, file.string());
}

/// Returns how many it took out.
std::size_t dropFlatTriangles(TriangleMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.areaNormal(i).squaredNorm() > 0.0) {
      mesh.triangles[kept] = mesh.triangles[i];
      mesh.triangle_materials[kept] = mesh.triangle_materials[i];
      ++kept;
    }
  }
  const std::size_t dropped = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  mesh.triangle_materials.resize(kept);
  return dropped;
}

void warnOfSize(const TriangleMesh& mesh, std::vector<std::string>& warnings) {
  const float size_m = mesh.bounds().sizes().maxCoeff();
  if (size_m > kLargestFurniture_m || size_m < kSmallestThing_m) {
    warnings.push_back("is " + base::toFixedText(size_m, size_m < 1.0F ? 6 : 1) + " m in size: is it in metres?");
  }
}

void warnOfMissing(const AssimpScene& loaded, const ModelFolder& folder, std::vector<std::string>& warnings) {
  for (const std::string& name : loaded.missingFiles()) {
    warnings.push_back("names the file '" + name + "', which is missing; looked for " + folder.placeOf(name));
  }
}

// Not through Assimp: its PLY importer (5.2) writes past its memory or never ends on files that are slightly damaged.
TriangleMesh readPlyFile(const std::filesystem::path& file, std::size_t max_triangles) {
  geometry::ColoredMesh source = geometry::readPlyMesh(file);
  if (source.triangles.size() > max_triangles) {
    fail(file, "is too large: must have at most " + std::to_string(max_triangles) + " triangles");
  }
  TriangleMesh mesh;
  mesh.vertices = std::move(source.vertices.points);
  mesh.vertex_colors = std::move(source.vertices.colors);
  mesh.triangles = std::move(source.triangles);
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  mesh.materials.emplace_back();
  if (!mesh.vertex_colors.empty()) {
    mesh.materials[0].color_rgb.setOnes();
  }
  return mesh;
}

TriangleMesh readThroughAssimp(ModelFolder& folder, std::size_t max_triangles, std::vector<std::string>& warnings) {
  const MeshFormat format = meshFormatOf(folder.modelFile());
  const AssimpScene loaded(folder, format, max_triangles);
  warnOfMissing(loaded, folder, warnings);
  SceneMaterials materials(loaded.scene(), format, folder);
  TriangleMesh mesh = gatherScene(loaded.scene(), format, materials, warnings);
  warnings.insert(warnings.end(), materials.warnings().begin(), materials.warnings().end());
  return mesh;
}

}  // namespace

MeshFile readMesh(const std::filesystem::path& file, const MeshFileLimits& limits) {
  const MeshFormat format = meshFormatOf(file);
  ModelFolder folder(file, limits.max_bytes);
  MeshFile result;
  TriangleMesh mesh = format == MeshFormat::kPly ? readPlyFile(file, limits.max_triangles)
                                                 : readThroughAssimp(folder, limits.max_triangles, result.warnings);
  if (mesh.empty()) {
    fail(file, "holds no triangles");
  }
  if (const auto problems = validate(mesh); !problems.empty()) {
    fail(file, problems.front());
  }
  const std::size_t flat = dropFlatTriangles(mesh);
  if (mesh.empty()) {
    fail(file, "holds no triangle with an area: each of its " + std::to_string(flat) + " is a line or a point");
  }
  if (flat > 0) {
    result.warnings.push_back(std::to_string(flat) + " triangles without an area are left out");
  }
  result.mesh_model = weldVertices(mesh);
  warnOfSize(result.mesh_model, result.warnings);
  return result;
}

}  // namespace oikos::model
