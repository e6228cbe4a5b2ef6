// SPDX-License-Identifier: Apache-2.0
// From where to begin, when the camera is only roughly known.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "registration/align.h"
#include "registration/landmark/camera_prior.h"
#include "registration/landmark/landmark_scene.h"

namespace oikos::registration {

struct StartSearchConfig {
  double wide_m = 0.08;        ///< a prior with a greater deviation, or a greater one of its yaw, is always searched; another only
  double wide_deg = 4.0;       ///< where the answer from its middle does not fit
  double reach = 1.3;          ///< starts to all sides, so many deviations from the middle,
  double turn_reach = 1.0;     ///< and turned by so many
  int thinning = 4;            ///< one reading in so many rows and columns is looked at
  int iterations = 8;          ///< at most
  int best = 3;                ///< so many are gone on with
  double through_cost = 5.0;   ///< of a reading through the furniture, where one on it gains 1,
  double before_cost = 0.25;   ///< and of one before it
  double prior_share = 0.012;  ///< of the scan's readings, for each squared deviation from the prior

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("wide_m", wide_m);
    visitor("wide_deg", wide_deg);
    visitor("reach", reach);
    visitor("turn_reach", turn_reach);
    visitor("thinning", thinning);
    visitor("iterations", iterations);
    visitor("best", best);
    visitor("through_cost", through_cost);
    visitor("before_cost", before_cost);
    visitor("prior_share", prior_share);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

[[nodiscard]] bool isWide(const CameraPrior& prior, const StartSearchConfig& config);

/// Whether a search reaches poses that do not count as the same as the prior: after a map has found the camera, it does not.
[[nodiscard]] bool hasOtherStarts(const CameraPrior& prior, const StartSearchConfig& config);

/// What readings say of the furniture from some pose.
struct Readings {
  int all = 0;      ///< in the scan
  int on = 0;       ///< on the furniture,
  int through = 0;  ///< where it should be and is not,
  int before = 0;   ///< and before it
};

/// How well the furniture explains the scan from there, as a share of the readings, with what the prior says. A reading through a surface
/// weighs most: things hide what is there, and what is there cannot be seen through.
[[nodiscard]] double explains(const Readings& readings, const Eigen::Isometry3d& T_map_camera, const CameraPrior& prior,
                              const StartSearchConfig& config);

/// The most promising poses, the best first, out of a grid about the prior: each aligned in a few steps on few readings. The furniture that
/// is shown in `scene` counts.
[[nodiscard]] std::vector<Eigen::Isometry3d> findStarts(const LandmarkScene& scene, const Scan& scan, const CameraPrior& prior,
                                                        const AlignConfig& align_config, const StartSearchConfig& config);

}  // namespace oikos::registration
