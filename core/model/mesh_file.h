// SPDX-License-Identifier: Apache-2.0
// Triangle meshes from and to files that CAD programs know.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/model/triangle_mesh.h"

namespace oikos::model {

struct [[nodiscard]] MeshFile {
  TriangleMesh mesh_model;            ///< metres, z up; no triangle without area, no vertex without a triangle
  std::vector<std::string> warnings;  ///< what is probably not meant, one line each, without the file's name
};

struct MeshFileLimits {
  std::uintmax_t max_bytes = std::uintmax_t{512} << 20U;  ///< of the file and those that it names, together
  std::size_t max_triangles = 20'000'000;                 ///< with each mesh counted as often as it is placed
};

/// OBJ + MTL (`.obj`), glTF 2.0 (`.gltf`, `.glb`), PLY (`.ply`; triangles and vertex colours: geometry::readPlyMesh), STL (`.stl`) or
/// COLLADA (`.dae`), by the name's ending. glTF is turned from its y up; COLLADA by its up_axis and to metres by its unit; the others are
/// taken as they are: metres, z up. All meshes of the scene are gathered where its nodes place them, at rest. Colours are sRGB: glTF's,
/// which are linear, are converted. Textures may be PNG or JPEG, of the diffuse or base colour; transparency, other maps and animation are
/// left out.
///
/// The files that a model names must lie in its folder or below: see ModelFolder. Throws Error{kIo} if the file itself cannot be read, and
/// Error{kInput} with its name for a format that is not known, a damaged file, a texture that is missing or wrong, numbers that are not
/// finite, no triangle with an area, and more than the limits allow.
MeshFile readMesh(const std::filesystem::path& file, const MeshFileLimits& limits = {});

/// Writes `NAME.obj` with `NAME.mtl` and a `NAME_<n>.png` for each texture beside it, what others are named by last: whoever finds the OBJ
/// finds the rest. Characters of material names that OBJ has no place for become "_"; a name that is used twice gets a number. readMesh
/// gives the same surface back. `file` must end in ".obj". Throws Error{kIo} if something cannot be written.
void writeObj(const TriangleMesh& mesh, const std::filesystem::path& file);

}  // namespace oikos::model
