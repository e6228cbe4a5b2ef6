// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "semantic/history/event.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

/// What a person changed in home.xml, as events `edited`, `added` and `removed` at `time_ns`: one for each piece of furniture, joint, knob
/// and small object whose state differs (with both states) or that differs otherwise (with none), for each room, and for the home itself.
[[nodiscard]] std::vector<Event> editsBetween(const Home& before, const Home& after, std::int64_t time_ns);

}  // namespace oikos::semantic
