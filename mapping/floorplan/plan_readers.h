// SPDX-License-Identifier: Apache-2.0
// The formats behind readFloorPlan. Included by this folder's sources and its tests.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/floorplan/plan_file.h"

namespace oikos::mapping {

using Polyline = std::vector<Eigen::Vector2d>;  ///< drawing units

/// Where something stands in a file.
struct PlanSource {
  const std::filesystem::path& file;
  int line = 0;
};

/// Throws Error{kInput} at the source.
[[noreturn]] void refusePlan(const PlanSource& source, const std::string& what);

/// Chords of a curve bend by at most this much.
constexpr double kChordBend_rad = 0.2;

/// `d` of an SVG path: every command of SVG 1.1. Throws Error{kInput}.
[[nodiscard]] std::vector<Polyline> parseSvgPath(std::string_view text, const PlanSource& source);

/// A list of transforms as SVG 1.1 writes it, as one. Throws Error{kInput}.
[[nodiscard]] Eigen::Affine2d parseSvgTransform(std::string_view text, const PlanSource& source);

/// Numbers with spaces or commas between. Throws Error{kInput} for anything else.
[[nodiscard]] std::vector<double> parseSvgNumbers(std::string_view text, const PlanSource& source);

/// Points on an arc about `centre`, from the first angle to the second, both ends with it.
[[nodiscard]] Polyline arcPoints(const Eigen::Vector2d& centre, const Eigen::Vector2d& radii, double from_rad, double to_rad);

/// In drawing units, y up.
struct Drawing {
  std::vector<Polyline> lines;
  std::optional<double> metres_per_unit;  ///< as the file says
};

[[nodiscard]] Drawing readSvg(const std::string& text, const std::filesystem::path& file, const std::string& layer);
[[nodiscard]] Drawing readDxf(const std::string& text, const std::filesystem::path& file, const std::string& layer);

}  // namespace oikos::mapping
