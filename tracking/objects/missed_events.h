// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "semantic/history/event.h"
#include "semantic/history/history.h"
#include "semantic/model/home.h"
#include "tracking/objects/missed_test.h"

namespace oikos::tracking {

/// What the home's history is to know of a small object that was missed: `after` is where it was looked for. Nothing: it was not missed, or
/// the home no longer has it there. Without `recording`.
[[nodiscard]] std::optional<semantic::Event> missedEvent(const ObjectReading& reading, const semantic::Home& believed,
                                                         std::int64_t start_ns);

/// Whether the newest event of the object up to then says the same: it was missed at that place already.
[[nodiscard]] bool isKnown(const semantic::Event& missed, const semantic::History& history);

}  // namespace oikos::tracking
