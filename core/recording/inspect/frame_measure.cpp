// SPDX-License-Identifier: Apache-2.0
#include "core/recording/inspect/frame_measure.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace oikos::recording {

namespace {

double meanAbsoluteLaplacian(const cv::Mat& gray) {
  cv::Mat laplacian;
  cv::Laplacian(gray, laplacian, CV_16S);
  return cv::norm(laplacian, cv::NORM_L1) / static_cast<double>(gray.total());
}

/// Detail at half the resolution against detail at a quarter of it; the full resolution tells more of noise and compression than of blur.
double measureSharpness(const cv::Mat& gray) {
  cv::Mat half;
  cv::Mat quarter;
  cv::resize(gray, half, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::resize(half, quarter, {}, 0.5, 0.5, cv::INTER_AREA);
  const double coarse = meanAbsoluteLaplacian(quarter);
  return coarse > 0.0 ? meanAbsoluteLaplacian(half) / coarse : 0.0;
}

}  // namespace

FrameMeasure measureFrame(const camera::RgbdFrame& frame) {
  FrameMeasure measure;
  measure.sharpness = measureSharpness(frame.gray);
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
