// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/frame_plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "core/base/error.h"
#include "core/metrics/error_statistics.h"
#include "mapping/report/html.h"
#include "mapping/report/text.h"

namespace oikos::mapping {

namespace {

// Of the drawing, in its own units.
constexpr double kWidth = 1000.0;
constexpr double kLeft = 58.0;
constexpr double kRight = 988.0;
constexpr double kTop = 30.0;
constexpr double kBottom = 184.0;
constexpr double kStripTop = 190.0;
constexpr double kStripHeight = 8.0;
constexpr double kLabelBaseline = 216.0;
constexpr double kHeight = 224.0;
constexpr std::size_t kMaxBins = 465;  ///< two units each: what an eye can tell apart

/// A stretch of the drive.
struct Bin {
  double time_s = 0.0;  ///< of its middle
  double least = 0.0;
  double middle = 0.0;
  double greatest = 0.0;
  bool empty = true;
};

/// Tick marks at 1, 2 or 5 × 10^n.
struct Axis {
  double end = 1.0;
  double step = 1.0;
  int decimals = 0;
};

Axis axisUpTo(double greatest, int most_ticks) {
  Axis axis;
  const double rough = std::max(greatest, 1e-6) / most_ticks;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    axis.step = factor * decade;
    if (axis.step >= rough * (1.0 - 1e-9)) {
      break;
    }
  }
  axis.end = axis.step * std::ceil(greatest / axis.step - 1e-9);
  axis.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(axis.step) + 1e-9)));
  return axis;
}

double sinceStart(const MapReport& report, std::size_t frame) {
  return static_cast<double>(report.trajectory[frame].stamp_ns - report.trajectory.front().stamp_ns) * 1e-9;
}

Bin binOf(const MapReport& report, const std::vector<double>& values, std::size_t begin, std::size_t end) {
  Bin bin;
  std::vector<double> finite;
  std::copy_if(values.begin() + static_cast<std::ptrdiff_t>(begin), values.begin() + static_cast<std::ptrdiff_t>(end),
               std::back_inserter(finite), [](double value) { return std::isfinite(value); });
  bin.time_s = 0.5 * (sinceStart(report, begin) + sinceStart(report, end - 1));
  if (!finite.empty()) {
    const auto [least, greatest] = std::minmax_element(finite.begin(), finite.end());
    bin.least = *least;
    bin.greatest = *greatest;
    bin.empty = false;
    bin.middle = metrics::statisticsOf(std::move(finite)).median;
  }
  return bin;
}

std::vector<Bin> binsOf(const MapReport& report, const std::vector<double>& values) {
  const std::size_t count = std::min(values.size(), kMaxBins);
  std::vector<Bin> bins;
  for (std::size_t i = 0; i < count; ++i) {
    bins.push_back(binOf(report, values, i * values.size() / count, (i + 1) * values.size() / count));
  }
  return bins;
}

class Scale {
 public:
  Scale(double span_s, double end) : per_s_((kRight - kLeft) / std::max(span_s, 1e-9)), per_unit_((kBottom - kTop) / end) {}
  [[nodiscard]] double x(double time_s) const { return kLeft + per_s_ * time_s; }
  [[nodiscard]] double y(double value) const { return kBottom - per_unit_ * value; }
  [[nodiscard]] std::string point(double time_s, double value) const { return numberText(x(time_s), 1) + " " + numberText(y(value), 1); }

 private:
  double per_s_;
  double per_unit_;
};

std::string text(const char* style_class, double x, double y, const std::string& content) {
  return "<text class=\"" + std::string(style_class) + "\" x=\"" + numberText(x, 1) + "\" y=\"" + numberText(y, 1) + "\">" +
         escapeHtml(content) + "</text>\n";
}

std::string gridLines(const Axis& axis, const Scale& scale) {
  std::string svg;
  for (int i = 0; i * axis.step <= axis.end * (1.0 + 1e-9); ++i) {
    const double y = scale.y(i * axis.step);
    svg += "<path class=\"rule\" d=\"M" + numberText(kLeft, 0) + " " + numberText(y, 1) + "H" + numberText(kRight, 0) + "\"/>\n";
    svg += text("tick-y", kLeft - 8.0, y + 4.0, numberText(i * axis.step, axis.decimals));
  }
  return svg;
}

std::string timeLabels(double span_s, const Scale& scale) {
  const Axis axis = axisUpTo(span_s, 8);
  std::string svg;
  for (int i = 0; i * axis.step <= span_s * (1.0 + 1e-9); ++i) {
    svg += text("tick-x", scale.x(i * axis.step), kLabelBaseline, numberText(i * axis.step, axis.decimals) + (i == 0 ? " s" : ""));
  }
  return svg;
}

/// One closed shape and one line for each run of bins without a gap.
std::string curve(const std::vector<Bin>& bins, const Scale& scale, const std::string& style_class) {
  std::string band;
  std::string line;
  for (std::size_t begin = 0; begin < bins.size();) {
    std::size_t end = begin;
    while (end < bins.size() && !bins[end].empty) {
      line += (end == begin ? "M" : "L") + scale.point(bins[end].time_s, bins[end].middle);
      band += (end == begin ? "M" : "L") + scale.point(bins[end].time_s, bins[end].greatest);
      ++end;
    }
    for (std::size_t i = end; i > begin; --i) {
      band += "L" + scale.point(bins[i - 1].time_s, bins[i - 1].least);
    }
    band += end > begin ? "Z" : "";
    begin = end + 1;
  }
  return "<path class=\"band " + style_class + "\" d=\"" + band + "\"/>\n<path class=\"line " + style_class + "\" d=\"" + line + "\"/>\n";
}

std::string statusStrip(const MapReport& report, const Scale& scale) {
  std::string svg;
  const std::size_t count = report.frames.size();
  for (std::size_t begin = 0; begin < count;) {
    std::size_t end = begin + 1;
    while (end < count && report.frames[end].status == report.frames[begin].status) {
      ++end;
    }
    const double left = scale.x(sinceStart(report, begin));
    const double right = scale.x(sinceStart(report, std::min(end, count - 1)));
    svg += "<rect class=\"" + std::string(base::toString(report.frames[begin].status)) + "\" x=\"" + numberText(left, 1) + "\" y=\"" +
           numberText(kStripTop, 0) + "\" width=\"" + numberText(std::max(right - left, 1.5), 1) + "\" height=\"" +
           numberText(kStripHeight, 0) + "\"/>\n";
    begin = end;
  }
  return svg;
}

}  // namespace

std::string framePlot(const MapReport& report, const FramePlot& plot) {
  OIKOS_CHECK(plot.values.size() == report.frames.size() && report.trajectory.size() == report.frames.size());
  if (plot.values.empty()) {
    return "";
  }
  const std::vector<Bin> bins = binsOf(report, plot.values);
  double greatest = 0.0;
  for (const Bin& bin : bins) {
    greatest = std::max(greatest, bin.greatest);
  }
  const Axis axis = axisUpTo(greatest > 0.0 ? greatest : 1.0, 4);
  const double span_s = sinceStart(report, plot.values.size() - 1);
  const Scale scale(span_s, axis.end);
  return "<svg class=\"plot\" viewBox=\"0 0 " + numberText(kWidth, 0) + " " + numberText(kHeight, 0) + "\" role=\"img\" aria-label=\"" +
         escapeHtml(plot.label) + "\">\n" + text("unit", 0.0, 12.0, plot.unit) + gridLines(axis, scale) + timeLabels(span_s, scale) +
         curve(bins, scale, plot.style_class) + statusStrip(report, scale) + "</svg>\n";
}

}  // namespace oikos::mapping
