// SPDX-License-Identifier: Apache-2.0
// What each pixel of a rendered model says about where its links are. Included by this folder's sources only.
#pragma once

#include <Eigen/Geometry>

#include "core/render/view.h"
#include "registration/articulated/joint_equations.h"
#include "registration/articulated/joint_tree.h"
#include "registration/articulated/pixel_mixture.h"
#include "registration/edge_pairs.h"
#include "registration/scan.h"

namespace oikos::registration {

struct PixelSource {
  const JointTree& tree;
  const Scan& scan;
  const ScanEdges& edges;
  const PixelMixture& mixture;
  const Eigen::Isometry3d& T_map_camera;
  double surface_sigma_m;  ///< what the model may be wrong by, in the end,
  double width_m;          ///< and for now: readings within some of these are taken for the surface
};

/// Distances of readings from the planes of the model, each weighted with how likely it is a reading of them; counts pixels by link.
/// `view`: of WholeModel, from the scan's camera.
void addSurfaceTerms(const render::View& view, const PixelSource& source, JointEquations& equations);

/// Distances of the scan's jumps in depth from the model's outlines: they hold what slides along itself, such as a front that is seen from
/// straight ahead.
void addOutlineTerms(const render::View& view, const PixelSource& source, JointEquations& equations);

}  // namespace oikos::registration
