// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "semantic/model/home.h"

namespace oikos::demo {

/// The sample apartment `homes/demo`: hall with dock, kitchen, living room, bedroom, bathroom, everything described by its dimensions.
[[nodiscard]] semantic::Home makeDemoHome();

}  // namespace oikos::demo
