// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/knob_detector.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/config_rules.h"
#include "core/base/error.h"

namespace oikos::recognition {

namespace {

constexpr int kMargin_px = 6;  // the normalisation of a window's outermost cells looks at one cell more
constexpr int kPhase_px = 3;   // windows are half a cell apart
constexpr int kLayers = 4;

float scoreOf(const HogCells& cells, int column, int row, const DetectorModel& model) {
  float sum = model.bias;
  const auto stride = static_cast<std::size_t>(kWindowCells * cells.orientations);
  for (int i = 0; i < kWindowCells; ++i) {
    const float* values = cells.at(column, row + i);
    const float* weights = &model.weights[static_cast<std::size_t>(i) * stride];
    for (std::size_t k = 0; k < stride; ++k) {
      sum += values[k] * weights[k];
    }
  }
  return sum;
}

bool isInPicture(const FaceImage& image, const KnobDetection& found) {
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector2d side(corner % 2 == 0 ? -1.0 : 1.0, corner < 2 ? -1.0 : 1.0);
    if (!image.camera.contains(projectPatch(image.view, image.camera, found.centre_patch + found.radius_m * side))) {
      return false;
    }
  }
  return true;
}

/// Windows of one layer, a knob in them `radius_m` large.
void detectInLayer(const FaceImage& image, double radius_m, const DetectorModel& model, const DetectorConfig& config,
                   std::vector<KnobDetection>& found) {
  PatchGrid grid;
  grid.px_per_m = kWindowRadius_px / radius_m;
  const int reach_px = static_cast<int>(std::ceil(config.search_m * grid.px_per_m));
  const int side = kWindow_px + 2 * kMargin_px + 2 * reach_px;
  grid.size = {side, side};
  grid.origin_px = Eigen::Vector2d::Constant((side - 1) / 2.0);
  static const std::vector<cv::Point> kStarts = {{0, 0}, {kPhase_px, 0}, {0, kPhase_px}, {kPhase_px, kPhase_px}};
  const std::vector<HogCells> phases = model.describe(samplePatch(image.color, image.camera, image.view, grid), kStarts);
  OIKOS_CHECK(phases.size() == kStarts.size());
  for (std::size_t phase = 0; phase < phases.size(); ++phase) {
    const cv::Point& start = kStarts[phase];
    const HogCells& cells = phases[phase];
    OIKOS_CHECK(static_cast<int>(model.weights.size()) == kWindowCells * kWindowCells * cells.orientations);
    for (int row = 0; row + kWindowCells <= cells.rows; ++row) {
      for (int column = 0; column + kWindowCells <= cells.columns; ++column) {
        const double score = scoreOf(cells, column, row, model);
        if (score <= config.min_score) {
          continue;
        }
        const Eigen::Vector2d middle_px(start.x + kMargin_px + 6 * column + (kWindow_px - 1) / 2.0,
                                        start.y + kMargin_px + 6 * row + (kWindow_px - 1) / 2.0);
        const KnobDetection detection{(middle_px - grid.origin_px) / grid.px_per_m, radius_m, score};
        if (detection.centre_patch.norm() <= config.search_m && isInPicture(image, detection)) {
          found.push_back(detection);
        }
      }
    }
  }
}

std::vector<KnobDetection> bestApart(std::vector<KnobDetection> found, double apart_m) {
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<KnobDetection> kept;
  for (const KnobDetection& detection : found) {
    if (std::all_of(kept.begin(), kept.end(), [&](const auto& k) { return (k.centre_patch - detection.centre_patch).norm() >= apart_m; })) {
      kept.push_back(detection);
    }
  }
  return kept;
}

}  // namespace

std::vector<std::string> DetectorConfig::validate() const {
  return base::ConfigRules()
      .between("search_m", search_m, 0.001, 0.5)
      .between("layer_ratio", layer_ratio, 1.0, 2.0)
      .between("min_score", min_score, -10.0, 10.0)
      .messages();
}

std::vector<HogCells> describeByHog(const cv::Mat& patch, const std::vector<cv::Point>& starts) {
  const Gradients gradients = differentiate(patch);
  std::vector<HogCells> cells;
  cells.reserve(starts.size());
  for (const cv::Point& start : starts) {
    cells.push_back(normaliseByBlocks(histogramCells(gradients, kDetectorHog, start)));
  }
  return cells;
}

std::vector<KnobDetection> detectKnobs(const FaceImage& image, const DetectorModel& model, const DetectorConfig& config) {
  std::vector<KnobDetection> found;
  for (int layer = 0; layer < kLayers; ++layer) {
    const double scale = std::pow(config.layer_ratio, layer - (kLayers - 1) / 2.0);
    detectInLayer(image, image.radius_m * scale, model, config, found);
  }
  return bestApart(std::move(found), 0.8 * image.radius_m);
}

double scoreWindow(const FaceImage& image, const Eigen::Vector2d& centre_patch, const DetectorModel& model) {
  const std::vector<float> descriptor = describeWindow(image, centre_patch, model.describe);
  OIKOS_CHECK(descriptor.size() == model.weights.size());
  return std::inner_product(descriptor.begin(), descriptor.end(), model.weights.begin(), model.bias);
}

std::vector<float> describeWindow(const FaceImage& image, const Eigen::Vector2d& centre_patch, const CellDescriber& describe) {
  PatchGrid grid;
  const int side = kWindow_px + 2 * kMargin_px;
  grid.size = {side, side};
  grid.px_per_m = kWindowRadius_px / image.radius_m;
  grid.origin_px = Eigen::Vector2d::Constant((side - 1) / 2.0);
  grid.centre_patch = centre_patch;
  return describe(samplePatch(image.color, image.camera, image.view, grid), {cv::Point()}).at(0).values;
}

}  // namespace oikos::recognition
