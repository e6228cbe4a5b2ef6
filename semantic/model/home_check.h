// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "semantic/model/finding.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

/// What a schema cannot say. Errors: ids used twice, references that lead nowhere or to the wrong kind, no room, no default parking pose or
/// more than one, joints that form no tree, values outside limits, a knob in none of its states, axes without direction, shapes
/// that cannot be made. Warnings: words that the vocabulary lacks, furniture outside its room, a stored relation that the boxes contradict.
[[nodiscard]] std::vector<Finding> checkHome(const Home& home);

}  // namespace oikos::semantic
