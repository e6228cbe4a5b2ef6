// SPDX-License-Identifier: Apache-2.0
// What a fit to landmarks and the camera's prior say together. Included by this folder's sources only.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/geometry/se3.h"
#include "registration/landmark/camera_prior.h"
#include "registration/landmark/landmark_hypothesis.h"
#include "registration/landmark/landmark_refiner.h"
#include "registration/landmark/landmark_scene.h"
#include "registration/normal_equations.h"

namespace oikos::registration {

/// Scene, prior and configuration are kept by reference. Immutable, so thread-safe.
class PriorFusion {
 public:
  /// `only`: the landmark that the fit is to, where it is a single one.
  PriorFusion(const LandmarkScene& scene, const CameraPrior& prior, const LandmarkConfig& config, std::optional<int> only);

  /// What is answered where nothing was refined.
  [[nodiscard]] LandmarkRefinement priorAlone() const;
  /// From the prior to the fit, in deviations of both together.
  [[nodiscard]] double deviations(const LandmarkFit& fit) const;
  /// Whether a rival is somewhere else than the fit, as far as that was observed.
  [[nodiscard]] bool isElsewhere(const LandmarkFit& fit, const Eigen::Isometry3d& T_map_rival) const;
  /// The weighted mean of both: the prior answers for what was not observed. Sets pose, covariance, what was not observed and the way.
  void fuse(const LandmarkFit& fit, LandmarkRefinement& answer) const;

 private:
  /// How a single piece that stands a little elsewhere, and turned, moves the robot's x, y and yaw: of many, each has its own error; of
  /// one, all surfaces are wrong together.
  [[nodiscard]] StepMatrix ownPlacement(const Eigen::Isometry3d& T_map_camera) const;
  [[nodiscard]] geometry::Matrix6d covariance6(const StepMatrix& planar, const Eigen::Isometry3d& T_map_camera) const;

  const LandmarkScene& scene_;
  const CameraPrior& prior_;
  const LandmarkConfig& config_;
  std::optional<int> only_;
};

}  // namespace oikos::registration
