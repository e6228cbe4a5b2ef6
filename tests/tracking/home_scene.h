// SPDX-License-Identifier: Apache-2.0
// A home's furniture, and what stands on and in it, to be rendered.
#pragma once

#include <Eigen/Core>

#include "core/render/scene.h"
#include "semantic/model/home.h"

namespace oikos::tracking {

/// All pieces of the first room where they stand, their joints as they are, and the small objects on them. Shapes need no files.
void addFurniture(render::Scene& scene, const semantic::Home& home);

/// A grey box of map, from corner to corner: floors, walls and what else nobody has told the home of.
void addBox(render::Scene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high);

}  // namespace oikos::tracking
