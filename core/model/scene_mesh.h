// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/model/scene_materials.h"

namespace oikos::model {

/// All meshes of a scene where its nodes place them, in one, with a warning for each thing that is left out. Vertices are not shared yet.
[[nodiscard]] TriangleMesh gatherScene(const aiScene& scene, MeshFormat format, SceneMaterials& materials,
                                       std::vector<std::string>& warnings);

}  // namespace oikos::model
