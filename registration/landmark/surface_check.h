// SPDX-License-Identifier: Apache-2.0
// Whether each part of the furniture is where the others say that it is.
#pragma once

#include <string_view>
#include <vector>

#include "registration/edge_pairs.h"
#include "registration/landmark/landmark_scene.h"
#include "registration/motion.h"
#include "registration/normal_equations.h"
#include "registration/scan.h"

namespace oikos::registration {

struct SurfaceCheckConfig {
  double gate_m = 0.15;            ///< a shift up to here is measured
  double max_normal_deg = 40.0;    ///< between the normals of a pair
  int min_pixels = 40;             ///< visible ones of the scan: fewer are not judged
  double min_share = 0.65;         ///< of what speaks about it, pixels that are where the part is,
  double near_m = 0.05;            ///< and how near that is; a reading farther behind went through where the part should be
  double surface_sigma_m = 0.010;  ///< what the model and the sensor may be wrong by
  double normal_sigma_deg = 0.7;   ///< and its planes be turned by
  double min_observability = 10.0;
  double chance = 1e-5;  ///< how often a part that has not moved may be taken for one that has

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("gate_m", gate_m);
    visitor("max_normal_deg", max_normal_deg);
    visitor("min_pixels", min_pixels);
    visitor("min_share", min_share);
    visitor("near_m", near_m);
    visitor("surface_sigma_m", surface_sigma_m);
    visitor("normal_sigma_deg", normal_sigma_deg);
    visitor("min_observability", min_observability);
    visitor("chance", chance);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct SurfaceCheck {
  int pixels = 0;       ///< of the scan that it covers, with a reading
  int agreeing = 0;     ///< of these, near its surface
  int through = 0;      ///< of these, behind it, and so are their neighbours: the part is not there
  int before = 0;       ///< of these, far before it: they hide it and say nothing about it
  int just_before = 0;  ///< of these, within the gate before it: things on a worktop, or the part itself come forward
  bool judged = false;
  /// The step that would bring the camera to where this part alone has it, along what it observes; and its squared length in deviations
  /// over the value that chance allows: above 1 it has moved.
  Step own;
  double contradiction = 0.0;

  /// What is just before it may be the part itself, come forward: unless as much is far before it, for then something stands there. And
  /// clutter is more common, so that it takes two readings of it to outweigh one that agrees.
  [[nodiscard]] int visible() const { return agreeing + through + (just_before > before ? just_before / 2 : 0); }
  [[nodiscard]] double share() const { return visible() > 0 ? static_cast<double>(agreeing) / visible() : 0.0; }
};

/// One check a surface of `scene`, from where `motion` stands; `edges` are those of the scan, `joint` is the covariance of the estimate
/// that all of them made.
[[nodiscard]] std::vector<SurfaceCheck> checkSurfaces(const LandmarkScene& scene, const Motion& motion, const Scan& scan,
                                                      const ScanEdges& edges, const StepMatrix& joint, const SurfaceCheckConfig& config,
                                                      int threads);

}  // namespace oikos::registration
