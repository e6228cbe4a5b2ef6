// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "core/geometry/se3.h"
#include "registration/align.h"
#include "registration/landmark/camera_prior.h"
#include "registration/landmark/landmark_scene.h"
#include "registration/landmark/start_search.h"
#include "registration/landmark/surface_check.h"

namespace oikos::registration {

struct LandmarkConfig {
  AlignConfig align;
  SurfaceCheckConfig check;
  StartSearchConfig search;
  double min_share = 0.005;        ///< of the scan's readings; a piece that covers less is not in view
  int min_landmarks = 2;           ///< pieces that must agree; one alone cannot tell whether it was moved
  int max_rounds = 6;              ///< of solving and leaving out what disagrees
  double good_overlap = 0.7;       ///< a fit that is not, or that something contradicts, is tried again from other starts
  double max_deviations = 5.0;     ///< of the correction, in those of prior and fit together
  double upright_sigma_m = 0.01;   ///< of the camera's height, which is not corrected,
  double upright_sigma_deg = 0.4;  ///< and of its tilt

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("align", align);
    visitor("check", check);
    visitor("search", search);
    visitor("min_share", min_share);
    visitor("min_landmarks", min_landmarks);
    visitor("max_rounds", max_rounds);
    visitor("good_overlap", good_overlap);
    visitor("max_deviations", max_deviations);
    visitor("upright_sigma_m", upright_sigma_m);
    visitor("upright_sigma_deg", upright_sigma_deg);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class RefinementStatus {
  kTooFewLandmarks,  ///< too few pieces in view
  kNotConverged,     ///< they are in view, but the scan does not fit them
  kInconsistent,     ///< the pieces do not agree with each other, or not with the prior: some have been moved
  kAmbiguous,        ///< from elsewhere the scan is explained as well: a row of equal fronts whose end is not known
  kRefined,
};
constexpr auto enumTable(RefinementStatus) {
  return std::to_array<base::EnumName<RefinementStatus>>({{RefinementStatus::kTooFewLandmarks, "too few landmarks"},
                                                          {RefinementStatus::kNotConverged, "not converged"},
                                                          {RefinementStatus::kInconsistent, "inconsistent"},
                                                          {RefinementStatus::kAmbiguous, "ambiguous"},
                                                          {RefinementStatus::kRefined, "refined"}});
}

enum class LandmarkVerdict {
  kHidden,   ///< in view, but something stands before it
  kUsed,     ///< part of the answer
  kChanged,  ///< used, but for parts that are not as believed: an open door
  kMoved,    ///< not where it is believed to be: left out
};
constexpr auto enumTable(LandmarkVerdict) {
  return std::to_array<base::EnumName<LandmarkVerdict>>({{LandmarkVerdict::kHidden, "hidden"},
                                                         {LandmarkVerdict::kUsed, "used"},
                                                         {LandmarkVerdict::kChanged, "changed"},
                                                         {LandmarkVerdict::kMoved, "moved"}});
}

/// What one piece in view did for the answer.
struct LandmarkContribution {
  std::string id;
  LandmarkVerdict verdict = LandmarkVerdict::kHidden;
  int pixels = 0;       ///< of the scan, with a reading
  int agreeing = 0;     ///< of these, near its surface at the answer
  double weight = 0.0;  ///< its share of all agreeing pixels
  double contradiction =
      0.0;  ///< of its worst part that was not left out: above 1 it would have been; of a moved piece: what it was left out for
  std::vector<std::string> dropped_parts;  ///< of a changed piece
};

struct [[nodiscard]] LandmarkRefinement {
  RefinementStatus status = RefinementStatus::kTooFewLandmarks;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();  ///< the prior, where nothing was refined
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();      ///< of its right perturbation (m, rad), prior included
  std::vector<std::string> unobserved;                             ///< degrees of freedom that the prior had to answer for
  double moved_m = 0.0;                                            ///< the robot's middle
  double moved_rad = 0.0;
  double rms_m = 0.0;    ///< from the surfaces
  double overlap = 0.0;  ///< as of AlignResult
  int rounds = 0;
  std::vector<LandmarkContribution> landmarks;  ///< those in view, in the scene's order
};

/// One planar correction of the camera from all fixed furniture in view at once (S210-S219, S223). Pieces and parts that contradict what
/// the others say are left out one after the other; if not enough remain, or as many pieces were left out as remain, the answer is that the
/// landmarks are inconsistent. Where a search found an answer nearly as good elsewhere, or a better place that the fit slid away from, it
/// is ambiguous. `scene`: surfaces are shown and hidden meanwhile. `only`: one landmark on demand, which then suffices.
[[nodiscard]] LandmarkRefinement refineByLandmarks(LandmarkScene& scene, const Scan& scan, const CameraPrior& prior,
                                                   const LandmarkConfig& config, std::optional<int> only = std::nullopt);

}  // namespace oikos::registration
