// SPDX-License-Identifier: Apache-2.0
// A photograph's own brightness is of no use under another light: what it is taken for is where the knob's colours end. Those are found by
// k-means (Lloyd, "Least squares quantization in PCM", 1982, doi:10.1109/TIT.1982.1056489), started from what suits the colours so far
// worst.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "recognition/knobs/ring_images.h"

namespace oikos::recognition {

namespace {

constexpr int kColors = 4;  // body, mark and skirt, and the carrier beside a knob that is not round
using Colors = std::vector<cv::Vec3f>;

/// The face as it looks from straight above.
Colors facePixels(const FacePhoto& photo, const KnobFace& face) {
  constexpr int kRadius_px = 24;
  constexpr double kWithin = 0.97;  // in radii
  PatchGrid grid;
  grid.size = {2 * kRadius_px + 1, 2 * kRadius_px + 1};
  grid.origin_px = Eigen::Vector2d::Constant(kRadius_px);
  grid.px_per_m = kRadius_px / face.radius_m;
  const cv::Mat patch = samplePatch(photo.color, photo.camera, photo.view, grid);
  Colors pixels;
  for (int v = 0; v < patch.rows; ++v) {
    for (int u = 0; u < patch.cols; ++u) {
      if (std::hypot(u - kRadius_px, v - kRadius_px) < kWithin * kRadius_px) {
        pixels.push_back(patch.at<cv::Vec3f>(v, u));
      }
    }
  }
  return pixels;
}

std::size_t nearestOf(const Colors& colors, const cv::Vec3f& pixel) {
  const auto nearest = std::min_element(colors.begin(), colors.end(),
                                        [&](const cv::Vec3f& a, const cv::Vec3f& b) { return cv::norm(a - pixel) < cv::norm(b - pixel); });
  return static_cast<std::size_t>(nearest - colors.begin());
}

/// Each colour to the mean of what is nearest to it, a few times.
void settle(Colors& colors, const Colors& pixels) {
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    Colors sums(colors.size(), cv::Vec3f());
    std::vector<int> counts(colors.size(), 0);
    for (const cv::Vec3f& pixel : pixels) {
      const std::size_t nearest = nearestOf(colors, pixel);
      sums[nearest] += pixel;
      ++counts[nearest];
    }
    for (std::size_t i = 0; i < colors.size(); ++i) {
      colors[i] = counts[i] > 0 ? sums[i] * (1.0F / static_cast<float>(counts[i])) : colors[i];
    }
  }
}

Colors mainColors(const Colors& pixels) {
  constexpr double kFar = 0.98;  // of the pixels are nearer to the colours so far: the others may be glints
  Colors colors = {cv::Vec3f()};
  settle(colors, pixels);
  while (colors.size() < kColors) {
    std::vector<std::pair<double, std::size_t>> distances;
    distances.reserve(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      distances.emplace_back(cv::norm(pixels[i] - colors[nearestOf(colors, pixels[i])]), i);
    }
    std::sort(distances.begin(), distances.end());
    colors.push_back(pixels[distances[static_cast<std::size_t>(kFar * static_cast<double>(distances.size()))].second]);
    settle(colors, pixels);
  }
  return colors;
}

/// CV_8UC4 of the photograph's size: 255 in the channel of the nearest colour.
cv::Mat maskColors(const cv::Mat& photo, const Colors& colors) {
  static_assert(kColors == 4);
  cv::Mat smooth;
  cv::GaussianBlur(photo, smooth, cv::Size(3, 3), 0.7);
  cv::Mat masks = cv::Mat::zeros(photo.size(), CV_8UC4);
  for (int v = 0; v < photo.rows; ++v) {
    for (int u = 0; u < photo.cols; ++u) {
      const cv::Vec3f pixel = cv::Vec3f(smooth.ptr<cv::Vec3b>(v)[u]) * (1.0F / 255.0F);
      masks.ptr<cv::Vec4b>(v)[u][static_cast<int>(nearestOf(colors, pixel))] = 255;
    }
  }
  return masks;
}

/// What of the window a cylinder covers whose face is the knob's: masks of its face, of its sides, and of these times the normal across the
/// tilt.
struct Cylinder {
  cv::Mat face;
  cv::Mat sides;
  cv::Mat sides_across;
};

Cylinder drawCylinder(const KnobFace& face, const RingWindow& window) {
  Cylinder drawn;
  for (cv::Mat* mask : {&drawn.face, &drawn.sides, &drawn.sides_across}) {
    *mask = cv::Mat::zeros(window.rows, window.columns, CV_32FC1);
  }
  constexpr int kSamples = 4;
  constexpr float kShare = 1.0F / (kSamples * kSamples);
  const double foot_m = face.height_m * std::tan(window.tilt_rad);  // how far below its face the foot is seen
  const auto metres = [&](int sample, int origin_px) { return ((sample + 0.5) / kSamples - 0.5 - origin_px) / window.px_per_m; };
  for (int v = 0; v < window.rows * kSamples; ++v) {
    for (int u = 0; u < window.columns * kSamples; ++u) {
      const double x_m = metres(u, window.origin_column);
      const double y_m = metres(v, window.origin_row);
      const cv::Point at(u / kSamples, v / kSamples);
      if (std::hypot(x_m, y_m) <= face.radius_m) {
        drawn.face.at<float>(at) += kShare;
      } else if (std::hypot(x_m, y_m - std::clamp(y_m, 0.0, foot_m)) <= face.radius_m) {
        drawn.sides.at<float>(at) += kShare;
        drawn.sides_across.at<float>(at) += kShare * static_cast<float>(x_m / face.radius_m);
      }
    }
  }
  return drawn;
}

}  // namespace

std::vector<TemplateImages> photoImages(const FacePhoto& photo, const KnobFace& face, const RingWindow& window, int angles) {
  const cv::Mat masks = maskColors(photo.color, mainColors(facePixels(photo, face)));
  const Cylinder cylinder = drawCylinder(face, window);
  PatchGrid grid;
  grid.size = {window.columns, window.rows};
  grid.origin_px = Eigen::Vector2d(window.origin_column, window.origin_row);
  grid.px_per_m = window.px_per_m;
  std::vector<TemplateImages> templates;
  for (int i = 0; i < angles; ++i) {
    // On the face's plane, turning the knob and walking about it are the same.
    FaceView view = photo.view;
    view.azimuth_rad = 2.0 * std::numbers::pi * i / angles + face.turn_sign * photo.angle_rad;
    TemplateImages images;
    cv::split(samplePatch(masks, photo.camera, view, grid), images.images);
    for (cv::Mat& mask : images.images) {
      mask = mask.mul(cylinder.face);
    }
    images.covered = cylinder.face + cylinder.sides;
    for (const cv::Mat& mask : {cylinder.sides, cylinder.sides_across, cv::Mat(1.0 - images.covered)}) {
      images.images.push_back(mask.clone());
      blurTemplate(images.images.back());
    }
    templates.push_back(std::move(images));
  }
  return templates;
}

}  // namespace oikos::recognition
