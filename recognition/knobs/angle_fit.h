// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recognition/knobs/angle_ring.h"
#include "recognition/knobs/face_patch.h"

namespace oikos::recognition {

/// The templates of a knob under one tilt: small ones that find its place, large ones that find its angle.
struct RingPair {
  AngleRing coarse;
  AngleRing fine;
};

/// A colour picture and where in it the face may be.
struct FitStart {
  const cv::Mat& color;  ///< CV_8UC3
  const camera::PinholeCamera& camera;
  const FaceView& view;
  double radius_m = 0.0;
  Eigen::Vector2d centre_patch = Eigen::Vector2d::Zero();
  double reach_m = 0.0;           ///< how far from there it may be, each way
  double belief_sigma_m = 0.005;  ///< how far from the middle of the view it is, each way
};

struct AngleFit {
  Eigen::Vector2d centre_patch = Eigen::Vector2d::Zero();  ///< where the face's middle is
  /// The share of the picture's variation that the template of this index leaves unexplained, 0 to 1, at the place that suits it best of
  /// those that are nearly as likely; AngleRing::bases says what an index means.
  std::vector<double> unexplained;
};

/// Where the templates fit best, and how well each does there.
[[nodiscard]] AngleFit fitAngle(const FitStart& start, const RingPair& rings);

}  // namespace oikos::recognition
