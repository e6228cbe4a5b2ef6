// SPDX-License-Identifier: Apache-2.0
#include "core/recording/inspect/frame_measure.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace oikos::recording {

namespace {

/// How much of the change from pixel to pixel survives another blur along one axis: little in a sharp picture, most in a blurred one
/// (Crete et al., "The Blur Effect: Perception and Estimation with a New No-Reference Perceptual Blur Metric", SPIE 2007). Unlike the
/// strength of the gradients it hardly depends on contrast and content.
double measureBlurAlong(const cv::Mat& gray, const cv::Size& kernel, const cv::Point& step) {
  cv::Mat blurred;
  cv::blur(gray, blurred, kernel);
  double changes = 0.0;
  double lost = 0.0;
  for (int v = step.y; v < gray.rows; ++v) {
    const float* pixels = gray.ptr<float>(v);
    const float* before = gray.ptr<float>(v - step.y) - step.x;
    const float* soft = blurred.ptr<float>(v);
    const float* soft_before = blurred.ptr<float>(v - step.y) - step.x;
    for (int u = step.x; u < gray.cols; ++u) {
      const float change = std::abs(pixels[u] - before[u]);
      const float kept = std::abs(soft[u] - soft_before[u]);
      changes += change;
      lost += std::max(0.0F, change - kept);
    }
  }
  return changes > 0.0 ? (changes - lost) / changes : 1.0;
}

/// At half the resolution; the full one tells more of noise and compression than of blur.
double measureBlur(const cv::Mat& gray) {
  constexpr int kReach_px = 9;
  cv::Mat half;
  cv::Mat half_float;
  cv::resize(gray, half, {}, 0.5, 0.5, cv::INTER_AREA);
  half.convertTo(half_float, CV_32F);
  return std::max(measureBlurAlong(half_float, {kReach_px, 1}, {1, 0}), measureBlurAlong(half_float, {1, kReach_px}, {0, 1}));
}

}  // namespace

FrameMeasure measureFrame(const camera::RgbdFrame& frame) {
  FrameMeasure measure;
  measure.blur = measureBlur(frame.gray);
  measure.valid_depth_share = static_cast<double>(cv::countNonZero(frame.depth_m > 0.0F)) / static_cast<double>(frame.depth_m.total());
  const int small_height = std::max(8, kSmallWidth * frame.gray.rows / frame.gray.cols);
  cv::Mat small;
  cv::resize(frame.gray, small, {kSmallWidth, small_height}, 0.0, 0.0, cv::INTER_AREA);
  small.convertTo(measure.small_gray, CV_32F);
  return measure;
}

double imageTurnRad(const FrameMeasure& from, const FrameMeasure& to, const camera::PinholeCamera& camera) {
  cv::Mat window;
  cv::createHanningWindow(window, from.small_gray.size(), CV_32F);
  const cv::Point2d shift = cv::phaseCorrelate(from.small_gray, to.small_gray, window);
  const double scale = static_cast<double>(camera.width) / kSmallWidth;
  return std::hypot(std::atan(shift.x * scale / camera.fx), std::atan(shift.y * scale / camera.fy));
}

}  // namespace oikos::recording
