// SPDX-License-Identifier: Apache-2.0
// A belief about which furniture stands where it is thought to, and what the scan says of it. Included by this folder's sources only.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "registration/align.h"
#include "registration/edge_pairs.h"
#include "registration/landmark/camera_prior.h"
#include "registration/landmark/landmark_refiner.h"
#include "registration/landmark/landmark_scene.h"
#include "registration/landmark/surface_check.h"
#include "registration/scan.h"

namespace oikos::registration {

/// The camera brought onto what is believed to be there.
struct LandmarkFit {
  AlignResult align;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// Which surfaces are believed to stand where they are thought to, and what follows.
struct LandmarkHypothesis {
  std::vector<char> used;            ///< one a surface
  std::vector<double> moved;         ///< one a landmark: the contradiction that it was left out for, or 0
  std::vector<int> dropped;          ///< surfaces of pieces that stay
  LandmarkFit fit;                   ///< to what is used
  std::vector<SurfaceCheck> checks;  ///< one a surface, from where the fit stands
  double score = 0.0;                ///< pixels that agree less those that contradict
  double explained = 0.0;            ///< as explains()

  /// Whether the surface is used and is not where the others say that it is.
  [[nodiscard]] bool contradicts(std::size_t surface) const { return used[surface] != 0 && checks[surface].contradiction > 1.0; }
  [[nodiscard]] bool contradictsAnywhere() const;
};

/// Fits and judges hypotheses. Scene, scan, prior and configuration are kept by reference; not thread-safe.
class HypothesisTester {
 public:
  HypothesisTester(LandmarkScene& scene, const Scan& scan, const CameraPrior& prior, const LandmarkConfig& config);

  /// Shows what is used, fits the camera to it from there, and examines it.
  void evaluate(LandmarkHypothesis& h, const Eigen::Isometry3d& T_map_camera_start);
  /// What the scan says of all surfaces from where the fit stands: checks, score, explained.
  void examine(LandmarkHypothesis& h) const;

 private:
  LandmarkScene& scene_;
  const Scan& scan_;
  ScanEdges edges_;
  const CameraPrior& prior_;
  const LandmarkConfig& config_;
};

/// Surfaces that may be left out next: the three that contradict most; and the base that most agrees, for it may have pulled the answer to
/// itself.
[[nodiscard]] std::vector<std::size_t> suspectsOf(const LandmarkHypothesis& h, const LandmarkScene& scene);

/// With its base a piece goes as a whole; a part that moves goes alone. What follows from it is to be evaluated.
void leaveOut(std::size_t surface, const LandmarkScene& scene, LandmarkHypothesis& h);

}  // namespace oikos::registration
