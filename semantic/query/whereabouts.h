// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "semantic/query/question.h"
#include "semantic/query/thing.h"

namespace oikos::semantic {

/// Whether the thing belongs to the room, the furniture or the moving part that is the whole.
[[nodiscard]] bool isPartOf(const Thing& thing, const Thing& whole);

/// Whether the thing is in that relation to the place; `floor`: to the floor of the room that is the place.
[[nodiscard]] bool isIn(const Thing& thing, PlaceRelation relation, const Thing& place, bool floor);

}  // namespace oikos::semantic
