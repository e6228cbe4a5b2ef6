// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/training/panel_print.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

namespace oikos::recognition {

namespace {

cv::Point pixelOf(const Eigen::Vector2d& point_panel) {
  return {static_cast<int>(std::lround((point_panel.x() + kPanelWidth_m / 2.0) * kPrintPixelsPerMetre)),
          static_cast<int>(std::lround((kPanelHeight_m / 2.0 - point_panel.y()) * kPrintPixelsPerMetre))};
}

Eigen::Vector2d towards(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

void printText(cv::Mat& print, const std::string& text, const Eigen::Vector2d& middle_panel, double size, const cv::Scalar& ink) {
  int baseline = 0;
  const cv::Size box = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, &baseline);
  cv::putText(print, text, pixelOf(middle_panel) + cv::Point(-box.width / 2, box.height / 2), cv::FONT_HERSHEY_SIMPLEX, size, ink, 1,
              cv::LINE_AA);
}

/// Ticks, dots or digits around a knob, and a line around it now and then. They do not turn with it.
void printScale(cv::Mat& print, const DrawnKnob& knob, const cv::Scalar& ink, Random& random) {
  const double r = knob.size.radius_m;
  const int style = random.below(4);
  const int count = 4 + random.below(9);
  const double start = random.between(0.0, 2.0 * std::numbers::pi);
  const double span = random.between(4.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d direction = towards(start - span * i / count);
    const Eigen::Vector2d near = knob.position_panel + random.between(1.1, 1.15) * r * direction;
    if (style == 0) {
      cv::line(print, pixelOf(near), pixelOf(near + random.between(0.1, 0.25) * r * direction), ink, 1 + random.below(2), cv::LINE_AA);
    } else if (style == 1) {
      cv::circle(print, pixelOf(near + 0.1 * r * direction), 1 + random.below(2), ink, cv::FILLED, cv::LINE_AA);
    } else {
      printText(print, std::to_string(style == 2 ? i : 50 * i), knob.position_panel + 1.4 * r * direction, style == 2 ? 0.32 : 0.25, ink);
    }
  }
  if (random.chance(0.2)) {
    cv::circle(print, pixelOf(knob.position_panel), static_cast<int>(random.between(1.08, 1.3) * r * kPrintPixelsPerMetre), ink,
               1 + random.below(2), cv::LINE_AA);
  }
}

/// Symbols anywhere: rings, discs, frames, names.
void printSymbols(cv::Mat& print, const cv::Scalar& ink, Random& random) {
  const std::vector<std::string> names = {"HOME", "TURBO", "ECO 40", "max", "230 V", "A+++", "GRILL", "0-I"};
  const int count = random.below(9);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d middle(random.between(-0.24, 0.24), random.between(-0.11, 0.11));
    const int size = static_cast<int>(random.between(0.003, 0.016) * kPrintPixelsPerMetre);
    const int kind = random.below(5);
    const int thickness = random.chance(0.3) ? cv::FILLED : 1 + random.below(2);
    if (kind == 0) {
      cv::circle(print, pixelOf(middle), size, ink, thickness, cv::LINE_AA);
    } else if (kind == 1) {
      cv::rectangle(print, pixelOf(middle) - cv::Point(size, size), pixelOf(middle) + cv::Point(size, size / 2), ink, thickness,
                    cv::LINE_AA);
    } else if (kind == 2) {
      cv::line(print, pixelOf(middle), pixelOf(middle + random.between(0.01, 0.1) * towards(random.between(0.0, 6.3))), ink,
               1 + random.below(2), cv::LINE_AA);
    } else {
      printText(print, random.of(names), middle, random.between(0.25, 0.8), ink);
    }
  }
}

}  // namespace

cv::Mat printPanel(const std::vector<DrawnKnob>& knobs, const cv::Mat& ground, Random& random) {
  cv::Mat print = ground.clone();
  const cv::Scalar mean = cv::mean(print);
  const double luma = (mean[0] + mean[1] + mean[2]) / 3.0;
  const cv::Scalar ink = cv::Scalar::all(luma > 110.0 ? random.between(10.0, luma - 70.0) : random.between(luma + 70.0, 250.0));
  printSymbols(print, ink, random);
  for (const DrawnKnob& knob : knobs) {
    if (random.chance(0.85)) {
      printScale(print, knob, ink, random);
    }
  }
  return print;
}

}  // namespace oikos::recognition
