// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/camera/pinhole_camera.h"
#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

/// What all images of a recording share and the refinement may adjust.
struct SharedCalibration {
  camera::PinholeCamera camera;
  double readout_s = 0.0;      ///< from the first to the last image row (rolling shutter); row y is exposed at stamp + (y / height - 0.5) * readout_s
  double depth_scale = 1.0;    ///< true depth = scale * reading
};

struct BundleAdjustmentConfig {
  int max_iterations = 15;
  double pixel_sigma_px = 0.5;        ///< of one sighting
  double cauchy_sigmas = 2.0;         ///< robust kernel of sightings
  double host_depth_weight = 1.0;     ///< of the host's reading's information
  double sighting_depth_weight = 0.2; ///< of the other readings' information: they share errors with each other
  bool refine_readout = false;
  double readout_prior_s = 0.02;
  bool refine_intrinsics = false;
  double focal_prior = 0.005;         ///< relative standard deviation of the focal lengths
  double centre_prior_px = 3.0;
  bool refine_depth_scale = false;
  double depth_scale_prior = 0.005;
};

struct [[nodiscard]] BundleAdjustmentResult {
  bool usable = false;
  int iterations = 0;
  int sightings = 0;
  double initial_cost = 0.0;
  double final_cost = 0.0;
  double rms_px = 0.0;         ///< reprojection, sightings within 3 sigma
  SharedCalibration calibration;
};

/// Global refinement: poses of all nodes (the first of each sub-map fixed) and inverse depths of all landmarks from reprojection and
/// depth readings (S312, S316, S354). Each sub-map is on its own unless observations join them. Changes poses and inverse
/// depths of `graph`. Single-threaded and deterministic.
BundleAdjustmentResult adjustBundle(KeyframeGraph& graph, const SharedCalibration& start, const BundleAdjustmentConfig& config);

}  // namespace oikos::mapping
