// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/model/triangle_mesh.h"

namespace oikos::model {

/// The same surface with one vertex where several had the same numbers throughout, in the order of their first use; vertices that no
/// triangle uses are gone. In expected linear time.
[[nodiscard]] TriangleMesh weldVertices(const TriangleMesh& mesh);

}  // namespace oikos::model
