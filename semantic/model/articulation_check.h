// SPDX-License-Identifier: Apache-2.0
// What a schema cannot say of the parts that a piece of furniture is made of. Included by this folder's sources only.
#pragma once

#include <string>
#include <vector>

#include "semantic/model/finding.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

[[nodiscard]] bool hasPart(const LargeObject& object, const std::string& part);

/// Errors of parts, joints, handles and knobs, in the order of the file's kinds: parts that form no tree, joints and handles of no part,
/// limits and values that do not fit, knobs in none of their states. Nothing for a piece without parts.
void checkArticulation(const LargeObject& object, std::vector<Finding>& findings);

}  // namespace oikos::semantic
