// SPDX-License-Identifier: Apache-2.0
#include "core/tags/tag_detector.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/geometry/tone_curve.h"

namespace oikos::tags {

namespace {

constexpr int kMostWrongCells = 1;

/// Light in place of the bytes that a screen wants, stretched to the full range. In the stored picture an edge's half-covered pixels are
/// brighter than halfway, so that black squares look smaller than they are: by 0.4 px a side, 1 cm in a distance of 3 m.
cv::Mat toLight(const cv::Mat& gray) {
  double brightest = 0.0;
  cv::minMaxLoc(gray, nullptr, &brightest);
  const geometry::ToneCurve& curve = geometry::ToneCurve::instance();
  const float full = std::max(curve.toLight(static_cast<std::uint8_t>(brightest)), 1e-3F);
  cv::Mat light(gray.size(), CV_8UC1);
  for (int v = 0; v < gray.rows; ++v) {
    std::transform(gray.ptr(v), gray.ptr(v) + gray.cols, light.ptr(v),
                   [&](std::uint8_t byte) { return static_cast<std::uint8_t>(std::lround(255.0F * curve.toLight(byte) / full)); });
  }
  return light;
}

TagDetection toDetection(const apriltag_detection_t& found) {
  constexpr double kCentre_px = 0.5;  // libapriltag counts from the corner of the first pixel
  TagDetection detection{found.id, {}};
  for (std::size_t i = 0; i < 4; ++i) {
    detection.corners_px[i] = {found.p[i][0] - kCentre_px, found.p[i][1] - kCentre_px};
  }
  return detection;
}

}  // namespace

struct TagDetector::Impl {
  std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family{tag36h11_create(), tag36h11_destroy};
  std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector{apriltag_detector_create(), apriltag_detector_destroy};
};

TagDetector::TagDetector() : impl_(std::make_unique<Impl>()) {
  impl_->detector->nthreads = 1;
  impl_->detector->quad_decimate = 1.0F;
  apriltag_detector_add_family_bits(impl_->detector.get(), impl_->family.get(), kMostWrongCells);
}

TagDetector::~TagDetector() = default;
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;

std::vector<TagDetection> TagDetector::detect(const cv::Mat& gray) const {
  OIKOS_CHECK(gray.type() == CV_8UC1 && !gray.empty());
  cv::Mat pixels = toLight(gray);
  image_u8_t image{pixels.cols, pixels.rows, static_cast<std::int32_t>(pixels.step), pixels.data};
  const std::unique_ptr<zarray_t, void (*)(zarray_t*)> found(apriltag_detector_detect(impl_->detector.get(), &image),
                                                             apriltag_detections_destroy);
  std::map<int, std::vector<TagDetection>> by_id;
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* one = nullptr;
    zarray_get(found.get(), i, static_cast<void*>(&one));
    by_id[one->id].push_back(toDetection(*one));
  }
  std::vector<TagDetection> detections;
  for (const auto& [id, all] : by_id) {
    if (all.size() == 1) {
      detections.push_back(all.front());
    }
  }
  return detections;
}

}  // namespace oikos::tags
