// SPDX-License-Identifier: Apache-2.0
// What the templates of a ring are made of: images of a knob's parts from one tilt, by its render or by a photograph.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "recognition/knobs/angle_ring.h"

namespace oikos::recognition {

/// The pixels of a template. Frame `patch`: as FaceView's, for a camera at azimuth 0 of the ring; its origin is at (origin_column,
/// origin_row).
struct RingWindow {
  int columns = 0;
  int rows = 0;
  int origin_column = 0;
  int origin_row = 0;
  double px_per_m = 1.0;
  double tilt_rad = 0.0;
};
[[nodiscard]] RingWindow windowOf(const KnobFace& face, double tilt_rad, const RingShape& shape);

/// Images of the window's size, CV_32FC1. Any picture of the knob at one angle is about a sum of `images`, each times a number.
struct TemplateImages {
  std::vector<cv::Mat> images;  ///< the last: the mask of what the knob stands on
  cv::Mat covered;              ///< the share of each pixel that the knob covers
};

/// As pictures are that are resampled on a template's pixels.
void blurTemplate(cv::Mat& image);

/// Of each material its mask, and the mask times each component of the normal; template i at azimuth 2 pi i / angles of a knob at angle 0.
[[nodiscard]] std::vector<TemplateImages> renderImages(const KnobDescription& knob, const KnobFace& face, const RingWindow& window,
                                                       int angles);

/// On the face, masks of where the photograph has each of its main colours, which stand for materials and what light makes of them; below
/// it those of a cylinder's sides and of the same times the normal across the tilt.
[[nodiscard]] std::vector<TemplateImages> photoImages(const FacePhoto& photo, const KnobFace& face, const RingWindow& window, int angles);

}  // namespace oikos::recognition
