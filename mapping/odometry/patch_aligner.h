// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mapping/odometry/image_pyramid.h"

namespace oikos::mapping {

/// Sub-pixel search for a patch of one image in another: inverse compositional Lucas-Kanade (Baker & Matthews, IJCV 2004) over
/// translation with gain and bias, the patch warped beforehand by a known affinity, coarse to fine.
struct PatchAlignerConfig {
  int max_iterations = 12;        ///< per level
  double converged_px = 0.02;     ///< a step below this ends the level
  double max_step_px = 3.0;       ///< in pixels of the level; a longer step counts as divergence
  double min_correlation = 0.75;  ///< zero-mean normalised cross-correlation at the answer
  int coarsest_answer = 2;        ///< a patch that aligns down to this level but not further is an answer too, a coarse one
  double min_eigenvalue = 4.0;    ///< least eigenvalue of the mean gradient matrix (grey values squared per pixel squared)

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_iterations", max_iterations);
    visitor("converged_px", converged_px);
    visitor("max_step_px", max_step_px);
    visitor("min_correlation", min_correlation);
    visitor("coarsest_answer", coarsest_answer);
    visitor("min_eigenvalue", min_eigenvalue);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct PatchQuery {
  Eigen::Vector2d host_px;           ///< the patch's centre in the host image, level 0
  Eigen::Vector2d start_px;          ///< where it should be in the target image, level 0
  Eigen::Matrix2d target_from_host;  ///< d(target pixel) / d(host pixel) there
  int coarsest_level = 0;            ///< search from this level of the pyramid down to level 0
};

struct [[nodiscard]] PatchMatch {
  bool found = false;
  Eigen::Vector2d target_px = Eigen::Vector2d::Zero();  ///< level 0
  double correlation = 0.0;                             ///< zero-mean normalised cross-correlation at `level`
  int level = 0;                                        ///< finest level that could be aligned; above 0 where the image is blurred
};

PatchMatch alignPatch(const ImagePyramid& host, const ImagePyramid& target, const PatchQuery& query, const PatchAlignerConfig& config);

}  // namespace oikos::mapping
