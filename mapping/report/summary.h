// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "mapping/report/figures.h"
#include "mapping/report/report.h"

namespace oikos::mapping {

enum class MapVerdict { kUsable, kUsableWithCare, kNotUsable };
constexpr auto enumTable(MapVerdict) {
  return std::to_array<base::EnumName<MapVerdict>>(
      {{MapVerdict::kUsable, "usable"}, {MapVerdict::kUsableWithCare, "usable-with-care"}, {MapVerdict::kNotUsable, "not-usable"}});
}

/// Something that an installer should know, and what helps.
struct Finding {
  MapVerdict weight = MapVerdict::kUsable;  ///< the best verdict that a map with this finding can have
  std::string what;                         ///< a sentence
  std::string advice;                       ///< a sentence; empty: nothing to do
};

/// The map in plain words, for the person who drove the robot.
struct MapSummary {
  MapVerdict verdict = MapVerdict::kNotUsable;
  std::string headline;  ///< "The map is usable."
  std::string story;     ///< what was done, in two or three sentences
  std::vector<Finding> findings;
};

[[nodiscard]] MapSummary summarise(const MapReport& report, const ReportFigures& figures);

}  // namespace oikos::mapping
