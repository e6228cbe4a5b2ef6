// SPDX-License-Identifier: Apache-2.0
// Left, right, before and behind. The front of a piece of furniture is its +x; left and right are as seen by someone who stands before it.
#pragma once

#include <vector>

#include "semantic/query/question.h"
#include "semantic/query/thing.h"

namespace oikos::semantic {

/// Whether the thing stands near, left of, right of, in front of, behind or above the other, in the same room and not farther than a few
/// metres; false for any other relation.
[[nodiscard]] bool isBeside(const Thing& thing, PlaceRelation relation, const Thing& other);

/// Of those that belong to one piece of furniture: the leftmost or rightmost.
[[nodiscard]] std::vector<const Thing*> pickBySide(const std::vector<const Thing*>& things, bool left);

}  // namespace oikos::semantic
