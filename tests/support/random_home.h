// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "semantic/model/home.h"

namespace oikos::test {

/// A valid home with every field set somewhere, each to a value of its own; the same for the same seed.
[[nodiscard]] semantic::Home randomHome(unsigned seed);

/// The home after one to three changes as a day brings them: a joint, a knob, a pose, an object that moves, comes, goes or is described
/// anew. Still valid.
[[nodiscard]] semantic::Home randomlyChanged(const semantic::Home& home, unsigned seed);

}  // namespace oikos::test
