// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/model/mesh_file.h"

namespace urdf {
class Link;
class Visual;
class Geometry;
class Mesh;
}  // namespace urdf

namespace oikos::model {

/// Makes meshes of what a URDF shows. Each mesh file is read once.
class UrdfVisuals {
 public:
  UrdfVisuals(std::filesystem::path urdf, const MeshFileLimits& limits) : urdf_(std::move(urdf)), limits_(limits) {}

  /// All that a link shows, in its frame; empty if it shows nothing. Throws as readUrdf does.
  [[nodiscard]] TriangleMesh meshOf(const urdf::Link& link);
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  [[nodiscard]] TriangleMesh shapeOf(const urdf::Geometry& geometry, const std::string& element);
  [[nodiscard]] TriangleMesh scaledMesh(const urdf::Mesh& mesh, const std::string& element);
  [[nodiscard]] const TriangleMesh& meshFile(const std::string& name, const std::string& element);
  void paint(TriangleMesh& mesh, const urdf::Visual& visual, const std::string& element);
  [[noreturn]] void fail(const std::string& element, const std::string& what) const;

  std::filesystem::path urdf_;
  MeshFileLimits limits_;
  std::map<std::string, TriangleMesh> meshes_;
  std::vector<std::string> warnings_;
};

}  // namespace oikos::model
