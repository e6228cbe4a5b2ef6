// SPDX-License-Identifier: Apache-2.0
// After 5.2.1 of paper 003 (S227-S235): the base first, then each part as its joint allows. Differs in that a joint's start is not its
// closed state but the best of its whole range, since one freedom can be searched to the end; and that what cannot be told from here is
// said.
#include "registration/articulated/articulated_registration.h"

#include "core/base/error.h"
#include "registration/articulated/conclusion.h"
#include "registration/articulated/joint_profile.h"
#include "registration/articulated/joint_search.h"
#include "registration/articulated/scan_window.h"

namespace oikos::registration {

ArticulatedRegistration::ArticulatedRegistration(const model::ArticulatedModel& model, const ArticulatedConfig& config)
    : tree_(model), config_(config), mixture_(config.mixture), layers_(tree_, config.threads), whole_(tree_, config.threads) {
  OIKOS_CHECK(config.validate().empty() && config.mixture.validate().empty() && config.solver.validate().empty() &&
              config.decision.validate().empty());
}

ArticulatedResult ArticulatedRegistration::run(const Scan& scan, const Eigen::Isometry3d& T_map_camera, const Standing& believed) {
  return run(scan, T_map_camera, believed, {config_.solver.base_sigma_m, config_.solver.base_sigma_deg, {}});
}

ArticulatedResult ArticulatedRegistration::run(const Scan& scan, const Eigen::Isometry3d& T_map_camera, const Standing& believed,
                                               const ImageContext& context) {
  OIKOS_CHECK(believed.joint_values.size() == tree_.model().joints.size() && context.base_sigma_m > 0.0 && context.base_sigma_deg > 0.0);
  ArticulatedConfig config = config_;
  config.solver.base_sigma_m = context.base_sigma_m;
  config.solver.base_sigma_deg = context.base_sigma_deg;
  JointSearch search(tree_, config, layers_, believed);
  const PixelWindow window = search.windowOfAll(T_map_camera, scan.camera);
  if (window.isEmpty()) {
    SolverReport nothing;
    nothing.base_covariance = priorCovariance(config.solver);
    return resultOf(tree_, config, search.findings(), nothing);
  }
  const Scan seen = cropped(scan, window);
  const Scan thin = thinned(seen, config.coarse_thinning);
  const PixelBox box{window.left, window.top, window.left + window.width, window.top + window.height};
  const Surroundings about = thinned(cropped(context.surroundings, box), config.coarse_thinning);
  JointProfiler profiler(tree_, layers_, thin, T_map_camera, mixture_, about);
  JointSolver solver(tree_, whole_, seen, mixture_, config.solver, T_map_camera, believed.T_map_model);
  search.lookForJoints(profiler);
  search.settleRivals(profiler, solver);
  search.solveAll(solver);
  if (search.compareAgain(profiler)) {
    search.solveAll(solver);
    search.compareAgain(profiler);
  }
  return resultOf(tree_, config, search.findings(), solver.report(search.findings().estimates, {.base = true, .links = search.movable()}));
}

}  // namespace oikos::registration
