// SPDX-License-Identifier: Apache-2.0
// What is said of a piece after its joints were looked for. Included by this folder's sources only.
#pragma once

#include "registration/articulated/articulated_config.h"
#include "registration/articulated/articulated_result.h"
#include "registration/articulated/joint_search.h"
#include "registration/articulated/joint_solver.h"
#include "registration/articulated/joint_tree.h"

namespace oikos::registration {

/// `report`: of the solver, where the findings stand; one without counts: nothing of the piece is in view. A joint is not observable,
/// whatever its readings, if what it hangs on is not there, or was carried too far to fit it.
[[nodiscard]] ArticulatedResult resultOf(const JointTree& tree, const ArticulatedConfig& config, const JointFindings& findings,
                                         const SolverReport& report);

}  // namespace oikos::registration
