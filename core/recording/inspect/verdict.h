// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/recording/inspect/inspection.h"

namespace oikos::recording {

/// What is wrong or missing, with what to do about it; the worst first.
[[nodiscard]] std::vector<Finding> findProblems(const Inspection& inspection, const Recording& recording, const InspectionConfig& config);

/// Bad with a fault, usable with a warning, else good.
[[nodiscard]] Verdict judge(const std::vector<Finding>& findings);

}  // namespace oikos::recording
