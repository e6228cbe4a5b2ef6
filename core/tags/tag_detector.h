// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace oikos::tags {

struct TagDetection {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners_px;  ///< of the black square, in TagBoard::findCorners' order; pixel centres at integers
};

/// Finds AprilTags of the family 36h11 at the image's full size (libapriltag: Wang and Olson, "AprilTag 2: Efficient and robust fiducial
/// detection", IROS 2016, doi:10.1109/IROS.2016.7759617). Not thread-safe; making one takes some tens of milliseconds.
class TagDetector {
 public:
  TagDetector();
  ~TagDetector();
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;

  /// In order of ids; an id that is seen twice is left out, as is one with more than one wrong cell. `gray`: CV_8UC1, sRGB.
  [[nodiscard]] std::vector<TagDetection> detect(const cv::Mat& gray) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace oikos::tags
