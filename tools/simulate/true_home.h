// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "semantic/model/home.h"
#include "tools/simulate/scene_script.h"

namespace oikos::simulate {

/// The home that is rendered: what `believed` says, with the errors of a tape measure, of fitters and of walls. The same for a seed.
[[nodiscard]] semantic::Home makeTrueHome(const semantic::Home& believed, const BeliefSettings& belief, std::uint64_t seed);

}  // namespace oikos::simulate
