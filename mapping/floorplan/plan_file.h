// SPDX-License-Identifier: Apache-2.0
// Floor plans from drawings.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mapping/floorplan/floor_plan.h"

namespace oikos::mapping {

struct PlanFileOptions {
  std::optional<double> metres_per_unit;  ///< of the drawing; nothing: what a DXF file says of itself ($INSUNITS), else 1
  std::string layer;                      ///< only what lies on it; empty: everything
};

/// Reads `.svg` and `.dxf` files: straight lines, and curves as chords of at most 11 degrees. Throws Error: kIo if the file
/// cannot be read, kInput with file and line for what is no drawing, for values that are wrong and for a drawing without lines or of
/// a size that no home has.
[[nodiscard]] FloorPlan readFloorPlan(const std::filesystem::path& file, const PlanFileOptions& options);

}  // namespace oikos::mapping
