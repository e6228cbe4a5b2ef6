// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/map_figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/error.h"
#include "core/recording/png_encoder.h"
#include "mapping/report/html.h"
#include "mapping/report/text.h"

namespace oikos::mapping {

namespace {

constexpr double kWidth = 1000.0;  ///< of the drawing, in its own units
constexpr double kMaxHeight = 720.0;
constexpr double kMinHeight = 320.0;
constexpr double kMargin_m = 0.3;  ///< around what is drawn
constexpr double kLeastExtent_m = 1.0;
constexpr double kLeastStep = 0.8;  ///< drawing units; points of a path that lie closer are left out

using Box = Eigen::AlignedBox2d;
using recording::Trajectory;

Eigen::Vector2d groundPoint(const recording::StampedPose& pose) {
  return pose.T_map_camera.translation().head<2>();
}

bool isKnown(std::uint8_t cell) {
  return cell == 0 || cell == 254;
}

/// Columns and rows of the picture that hold anything known.
cv::Rect knownPart(const cv::Mat& cells) {
  cv::Rect part;
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.cols; ++column) {
      if (isKnown(cells.at<std::uint8_t>(row, column))) {
        part |= cv::Rect(column, row, 1, 1);
      }
    }
  }
  return part;
}

Box boxOf(const cv::Rect& part, const GridPicture& grid) {
  const auto corner = [&grid](int column, int row) -> Eigen::Vector2d {
    return grid.origin_m + grid.resolution_m * Eigen::Vector2d(column, grid.cells.rows - row);
  };
  return {corner(part.x, part.y + part.height), corner(part.x + part.width, part.y)};
}

/// Where a point of the map lands in the drawing.
class View {
 public:
  explicit View(Box shown) {
    if (shown.isEmpty()) {
      shown.extend(Eigen::Vector2d::Zero());
    }
    const Eigen::Vector2d least = Eigen::Vector2d::Constant(kLeastExtent_m);
    const Eigen::Vector2d size_m = shown.sizes().cwiseMax(least) + 2.0 * Eigen::Vector2d::Constant(kMargin_m);
    scale_ = std::min(kWidth / size_m.x(), kMaxHeight / size_m.y());
    height_ = std::max(kMinHeight, scale_ * size_m.y());
    centre_m_ = shown.center();
  }
  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] double scale() const { return scale_; }  ///< drawing units a metre
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& point_m) const {
    const Eigen::Vector2d offset = scale_ * (point_m - centre_m_);
    return {0.5 * kWidth + offset.x(), 0.5 * height_ - offset.y()};
  }

 private:
  double scale_ = 1.0;
  double height_ = kMinHeight;
  Eigen::Vector2d centre_m_ = Eigen::Vector2d::Zero();
};

std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + numberText(value, 1) + "\"";
}

/// Free and occupied in greys that are seen on light and on dark ground; unknown lets the ground through.
std::string pngOf(const cv::Mat& cells) {
  cv::Mat picture(cells.size(), CV_8UC4, cv::Scalar(0, 0, 0, 0));
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.cols; ++column) {
      const std::uint8_t cell = cells.at<std::uint8_t>(row, column);
      if (isKnown(cell)) {
        picture.at<cv::Vec4b>(row, column) = cell == 0 ? cv::Vec4b(128, 112, 100, 255) : cv::Vec4b(160, 148, 138, 56);
      }
    }
  }
  const std::vector<std::uint8_t> bytes = recording::encodePng(picture, 9);
  return {bytes.begin(), bytes.end()};
}

std::string gridImage(const GridPicture& grid, const cv::Rect& part, const View& view) {
  if (part.empty()) {
    return "";
  }
  const Box box = boxOf(part, grid);
  const Eigen::Vector2d top_left = view({box.min().x(), box.max().y()});
  const Eigen::Vector2d size = view.scale() * box.sizes();
  return "<image" + attribute("x", top_left.x()) + attribute("y", top_left.y()) + attribute("width", size.x()) +
         attribute("height", size.y()) + " preserveAspectRatio=\"none\" class=\"grid\" href=\"data:image/png;base64," +
         base64(pngOf(grid.cells(part))) + "\"/>\n";
}

std::string pointText(const Eigen::Vector2d& point) {
  return numberText(point.x(), 1) + " " + numberText(point.y(), 1);
}

std::string pathLine(const Trajectory& trajectory, const View& view, const char* style_class) {
  std::string points;
  Eigen::Vector2d last = Eigen::Vector2d::Constant(-1e9);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Eigen::Vector2d point = view(groundPoint(trajectory[i]));
    if ((point - last).norm() >= kLeastStep || i + 1 == trajectory.size()) {
      points += (points.empty() ? "M" : "L") + pointText(point);
      last = point;
    }
  }
  return points.empty() ? "" : "<path class=\"" + std::string(style_class) + "\" d=\"" + points + "\"/>\n";
}

std::string loopLines(const MapReport& report, const View& view) {
  std::string lines;
  for (const bool accepted : {false, true}) {  // accepted ones on top
    for (const LoopFacts& loop : report.loops) {
      if ((loop.verdict == LoopVerdict::kAccepted) == accepted) {
        const Eigen::Vector2d from = view(groundPoint(report.trajectory[static_cast<std::size_t>(loop.from_frame)]));
        const Trajectory& targets = loop.is_to_earlier_drive ? report.extension->trajectory : report.trajectory;
        const Eigen::Vector2d to = view(groundPoint(targets[static_cast<std::size_t>(loop.to_frame)]));
        lines +=
            "<path class=\"" + std::string(accepted ? "loop" : "refused") + "\" d=\"M" + pointText(from) + "L" + pointText(to) + "\"/>\n";
      }
    }
  }
  return lines;
}

std::string keyframeDots(const MapReport& report, const View& view) {
  std::string dots;
  Eigen::Vector2d last = Eigen::Vector2d::Constant(-1e9);
  for (std::size_t i = 0; i < report.frames.size(); ++i) {
    const Eigen::Vector2d point = view(groundPoint(report.trajectory[i]));
    if (report.frames[i].is_keyframe && (point - last).norm() >= 3.0 * kLeastStep) {
      dots += "M" + pointText(point) + "h0";
      last = point;
    }
  }
  return dots.empty() ? "" : "<path class=\"keyframes\" d=\"" + dots + "\"/>\n";
}

std::string endMarks(const Trajectory& trajectory, const View& view) {
  if (trajectory.empty()) {
    return "";
  }
  const Eigen::Vector2d start = view(groundPoint(trajectory.front()));
  const Eigen::Vector2d end = view(groundPoint(trajectory.back()));
  return "<circle class=\"start\"" + attribute("cx", start.x()) + attribute("cy", start.y()) + " r=\"8\"/>\n<rect class=\"end\"" +
         attribute("x", end.x() - 6.0) + attribute("y", end.y() - 6.0) + " width=\"12\" height=\"12\"/>\n";
}

/// The greatest of 1, 2, 5 × 10^n metres that is at most a quarter of the width.
double scaleBarLength(double scale) {
  const double most_m = 0.25 * kWidth / scale;
  const double decade_m = std::pow(10.0, std::floor(std::log10(most_m)));
  const std::array<double, 3> steps = {5.0, 2.0, 1.0};
  const auto step = std::find_if(steps.begin(), steps.end(), [&](double s) { return s * decade_m <= most_m; });
  return (step == steps.end() ? 1.0 : *step) * decade_m;
}

std::string scaleBar(const View& view) {
  const double length_m = scaleBarLength(view.scale());
  const double right = kWidth - 24.0;
  const double left = right - length_m * view.scale();
  const double y = view.height() - 20.0;
  const std::string label = length_m >= 1.0 ? numberText(length_m, 0) + " m" : numberText(100.0 * length_m, 0) + " cm";
  return "<path class=\"scale\" d=\"M" + pointText({left, y - 6}) + "v6H" + numberText(right, 1) + "v-6\"/>\n<text class=\"scale-text\"" +
         attribute("x", 0.5 * (left + right)) + attribute("y", y - 8.0) + ">" + label + "</text>\n";
}

std::string planLines(const MapReport& report, const View& view) {
  std::string lines;
  if (report.plan) {
    for (const auto& [from_map, to_map] : report.plan->lines_map) {
      lines += "M" + pointText(view(from_map)) + "L" + pointText(view(to_map));
    }
  }
  return lines.empty() ? "" : "<path class=\"plan\" d=\"" + lines + "\"/>\n";
}

std::string changeBoxes(const ExtensionFacts& extension, const View& view) {
  std::string boxes;
  for (const Change& change : extension.changes) {
    const Eigen::Vector2d half_m = 0.5 * change.size_m.head<2>();
    const Eigen::Vector2d low = view(change.center_map.head<2>() - half_m);
    const Eigen::Vector2d high = view(change.center_map.head<2>() + half_m);
    boxes += "<rect class=\"change-" + std::string(base::toString(change.kind)) + "\"" + attribute("x", low.x()) +
             attribute("y", high.y()) + attribute("width", high.x() - low.x()) + attribute("height", low.y() - high.y()) + "/>\n";
  }
  return boxes;
}

Box shownPart(const MapReport& report, const cv::Rect& known) {
  Box shown;
  for (const Trajectory* trajectory : {&report.trajectory, &report.trajectory_before_loops}) {
    for (const recording::StampedPose& pose : *trajectory) {
      shown.extend(groundPoint(pose));
    }
  }
  if (report.extension) {
    for (const recording::StampedPose& pose : report.extension->trajectory) {
      shown.extend(groundPoint(pose));
    }
  }
  if (report.plan) {
    for (const auto& [from_map, to_map] : report.plan->lines_map) {
      shown.extend(from_map);
      shown.extend(to_map);
    }
  }
  return known.empty() ? shown : shown.merged(boxOf(known, report.grid));
}

}  // namespace

std::string mapFigure(const MapReport& report) {
  OIKOS_CHECK(report.grid.cells.empty() || (report.grid.cells.type() == CV_8UC1 && report.grid.resolution_m > 0.0));
  const cv::Rect known = report.grid.cells.empty() ? cv::Rect() : knownPart(report.grid.cells);
  const View view(shownPart(report, known));
  std::string svg = "<svg class=\"map\" viewBox=\"0 0 " + numberText(kWidth, 0) + " " + numberText(view.height(), 0) +
                    "\" role=\"img\" aria-label=\"The camera's path over the floor, from above\">\n";
  svg += gridImage(report.grid, known, view);
  svg += planLines(report, view);
  svg += report.extension ? pathLine(report.extension->trajectory, view, "earlier") + changeBoxes(*report.extension, view) : "";
  svg += pathLine(report.trajectory_before_loops, view, "before");
  svg += loopLines(report, view);
  svg += pathLine(report.trajectory, view, "after");
  svg += keyframeDots(report, view) + endMarks(report.trajectory, view) + scaleBar(view);
  return svg + "</svg>\n";
}

}  // namespace oikos::mapping
