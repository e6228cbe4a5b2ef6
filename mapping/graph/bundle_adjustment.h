// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

struct BundleAdjustmentConfig {
  int max_iterations = 20;
  double function_tolerance = 5e-4;     ///< a step that lowers the cost by a smaller share is the last
  double pixel_sigma_px = 0.5;          ///< of one sighting at pyramid level 0
  double cauchy_sigmas = 2.0;           ///< robust kernel of sightings
  double host_depth_weight = 1.0;       ///< of the information of the host's reading
  double sighting_depth_weight = 0.05;  ///< of that of the other readings: they share errors with each other
  double readout_sigma_s = 0.02;        ///< prior of the read-out time, about 0
  double settled_sigma_m = 0.001;       ///< of each motion between settled nodes that have an edge: all that is left of the sightings of
  double settled_sigma_rad = 0.001;     ///< the frames between them

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_iterations", max_iterations);
    visitor("function_tolerance", function_tolerance);
    visitor("pixel_sigma_px", pixel_sigma_px);
    visitor("cauchy_sigmas", cauchy_sigmas);
    visitor("host_depth_weight", host_depth_weight);
    visitor("sighting_depth_weight", sighting_depth_weight);
    visitor("readout_sigma_s", readout_sigma_s);
    visitor("settled_sigma_m", settled_sigma_m);
    visitor("settled_sigma_rad", settled_sigma_rad);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class Readout { kFixed, kRefined };

struct [[nodiscard]] BundleAdjustmentResult {
  bool usable = false;  ///< false: the graph is as it was
  int iterations = 0;
  int sightings = 0;
  double initial_cost = 0.0;  ///< half the sum of squared, robustified, whitened residuals
  double final_cost = 0.0;
  double rms_px = 0.0;     ///< reprojection, of the sightings within 3 sigma
  double readout_s = 0.0;  ///< from the first to the last image row; row y is exposed at stamp + (y / height - 0.5) * readout_s
};

/// Global refinement: poses of all nodes (the first of each sub-map fixed) and inverse depths of all landmarks, from reprojection
/// and depth readings (S312, S316, S354), and from what an earlier run has settled; with Readout::kRefined the rolling shutter's
/// read-out time, too. Changes poses and inverse depths of `graph`. Single-threaded and deterministic.
BundleAdjustmentResult adjustBundle(KeyframeGraph& graph, const camera::PinholeCamera& camera, double readout_start_s, Readout readout,
                                    const BundleAdjustmentConfig& config);

}  // namespace oikos::mapping
