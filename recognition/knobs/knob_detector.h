// SPDX-License-Identifier: Apache-2.0
// Where on the face's plane there is a knob: histograms of gradients and a linear support vector machine over a pyramid of four layers
// (the user's paper 003, 5.2.1.2 and 5.2.1.3), in the region where one is expected, seen as from straight above.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "recognition/knobs/face_patch.h"
#include "recognition/knobs/hog.h"

namespace oikos::recognition {

constexpr int kWindow_px = 48;
constexpr int kWindowRadius_px = 17;  ///< of a knob of the expected size in a window
constexpr HogShape kDetectorHog = {6, 9};
constexpr int kWindowCells = kWindow_px / 6;
constexpr int kDescriptorSize = kWindowCells * kWindowCells * 9;

/// What a patch (CV_32FC3, 0 to 1) looks like in cells of 6 px, counted from each of `starts` and without the outermost ring of them: the
/// normalisation of the others may look at it.
using CellDescriber = std::function<std::vector<HogCells>(const cv::Mat& patch, const std::vector<cv::Point>& starts)>;

/// kDetectorHog, normalised by blocks.
[[nodiscard]] std::vector<HogCells> describeByHog(const cv::Mat& patch, const std::vector<cv::Point>& starts);

/// A window's score is weights · descriptor + bias.
struct DetectorModel {
  std::vector<float> weights;  ///< cell by cell, row by row; kDescriptorSize for describeByHog
  float bias = 0.0F;
  float threshold = 0.0F;                  ///< of the score, where the detector has to decide alone
  CellDescriber describe = describeByHog;  ///< thread-safe
};

/// The model that the program was built with: `oikos model train knobs` with its defaults.
[[nodiscard]] const DetectorModel& shippedDetector();

/// A model for describeByHog. Text: `oikos-knob-detector 1`, the number of weights, the bias, the threshold, the weights. Throws
/// Error{kInput} that names `where`, the line, what was found and what would be right.
[[nodiscard]] DetectorModel parseDetector(std::string_view text, const std::string& where);
[[nodiscard]] std::string writeDetector(const DetectorModel& model);

struct DetectorConfig {
  double search_m = 0.025;    ///< how far a knob may be from where it is believed, on the face's plane
  double layer_ratio = 1.13;  ///< from layer to layer; the four are even about the expected size
  double min_score = -1.5;    ///< windows below it are no proposals

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("search_m", search_m);
    visitor("layer_ratio", layer_ratio);
    visitor("min_score", min_score);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct KnobDetection {
  Eigen::Vector2d centre_patch = Eigen::Vector2d::Zero();  ///< m, in the view's patch frame
  double radius_m = 0.0;
  double score = 0.0;
};

/// What is looked at: a picture, and the face of a knob as it is believed.
struct FaceImage {
  const cv::Mat& color;  ///< CV_8UC3
  const camera::PinholeCamera& camera;
  const FaceView& view;
  double radius_m = 0.0;
};

/// The best first; none nearer than 0.8 radii to a better one. Windows that reach out of the picture are not looked at.
[[nodiscard]] std::vector<KnobDetection> detectKnobs(const FaceImage& image, const DetectorModel& model, const DetectorConfig& config);

/// Of the window around a point of the patch's plane, for a knob of the expected size; also where the window reaches out of the picture.
[[nodiscard]] double scoreWindow(const FaceImage& image, const Eigen::Vector2d& centre_patch, const DetectorModel& model);

/// The descriptor of the window around a point of the patch's plane, for a knob of `radius_m`; what training gathers.
[[nodiscard]] std::vector<float> describeWindow(const FaceImage& image, const Eigen::Vector2d& centre_patch, const CellDescriber& describe);

}  // namespace oikos::recognition
