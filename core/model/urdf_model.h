// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "core/model/mesh_file.h"

namespace oikos::model {

struct [[nodiscard]] UrdfModel {
  ArticulatedModel model;             ///< parts and joints in the order of their names; handles and knobs are not in a URDF
  std::vector<std::string> warnings;  ///< what is probably not meant, one line each, with the element's name
};

/// Links become parts: all visual shapes of a link in one mesh in the link's frame, none at all for a link without. Boxes, cylinders and
/// spheres are those of primitives.h; meshes are read by readMesh from a path relative to the URDF, which may lead up
/// ("../meshes/door.obj": where ROS keeps them), and scaled. "package://" and other URLs are refused. A <material> of a visual replaces the
/// mesh's own; its texture is left out with a warning. Collision shapes and inertia are not read.
///
/// Revolute, continuous (without limits), prismatic and fixed joints; others are refused. The axis is brought to length 1. A joint that
/// mimics another becomes one that moves on its own, with a warning. All links must hang together as one tree.
///
/// Throws Error{kIo} if the file cannot be read, and Error{kInput} with its name and the link or joint for what is wrong in it; a mesh's
/// error names the mesh file too.
UrdfModel readUrdf(const std::filesystem::path& file, const MeshFileLimits& limits = {});

}  // namespace oikos::model
