// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/plan_file.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/read_file.h"
#include "mapping/floorplan/plan_readers.h"

namespace oikos::mapping {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;
constexpr std::size_t kMaxLines = 200000;
constexpr double kShortest_m = 0.01;
constexpr double kSmallest_m = 1.0;   ///< no home is smaller than this
constexpr double kLargest_m = 300.0;  ///< or larger than that

Drawing readDrawing(const std::filesystem::path& file, const std::string& layer) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (ending != ".svg" && ending != ".dxf") {
    throw base::Error(base::ErrorCode::kUsage, "is no floor plan that can be read: its name must end in .svg or .dxf", file.string());
  }
  const std::string text = base::readFile(file);
  if (text.size() > kMaxBytes) {
    throw base::Error(base::ErrorCode::kInput, "larger than 64 MiB", file.string());
  }
  return ending == ".svg" ? readSvg(text, file, layer) : readDxf(text, file, layer);
}

void checkSize(const FloorPlan& plan, const std::filesystem::path& file, double scale) {
  Eigen::AlignedBox2d box;
  for (const PlanLine& line : plan.lines) {
    box.extend(line.from_plan);
    box.extend(line.to_plan);
  }
  const double size_m = box.sizes().maxCoeff();
  if (!(size_m >= kSmallest_m && size_m <= kLargest_m)) {
    throw base::Error(base::ErrorCode::kInput,
                      "the plan is " + base::toText(size_m) + " m wide at " + base::toText(scale) +
                          " metres a unit; a home has 1 to 300 m: give the right scale",
                      file.string());
  }
}

}  // namespace

FloorPlan readFloorPlan(const std::filesystem::path& file, const PlanFileOptions& options) {
  const Drawing drawing = readDrawing(file, options.layer);
  const double scale = options.metres_per_unit.value_or(drawing.metres_per_unit.value_or(1.0));
  FloorPlan plan;
  for (const Polyline& polyline : drawing.lines) {
    for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
      const PlanLine line{scale * polyline[i], scale * polyline[i + 1], Eigen::Vector2d::Zero(), true, 0};
      if (line.lengthM() >= kShortest_m) {
        plan.lines.push_back(line);
      }
    }
  }
  const std::string where = options.layer.empty() ? "" : " on the layer \"" + options.layer + "\"";
  if (plan.lines.empty() && drawing.lines.empty()) {
    throw base::Error(base::ErrorCode::kInput, "holds no lines" + where, file.string());
  }
  if (plan.lines.size() > kMaxLines) {
    throw base::Error(base::ErrorCode::kInput, "holds more than 200000 lines" + where + ": leave the walls only", file.string());
  }
  checkSize(plan, file, scale);
  numberRooms(plan);
  return plan;
}

void refusePlan(const PlanSource& source, const std::string& what) {
  throw base::Error(base::ErrorCode::kInput, what, source.file.string() + ":" + base::toText(static_cast<std::int64_t>(source.line)));
}

Polyline arcPoints(const Eigen::Vector2d& centre, const Eigen::Vector2d& radii, double from_rad, double to_rad) {
  const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(to_rad - from_rad) / kChordBend_rad)));
  Polyline points;
  for (int i = 0; i <= chords; ++i) {
    const double angle_rad = from_rad + (to_rad - from_rad) * i / chords;
    points.push_back(centre + radii.cwiseProduct(Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad))));
  }
  return points;
}

}  // namespace oikos::mapping
