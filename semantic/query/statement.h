// SPDX-License-Identifier: Apache-2.0
// What a person says about the home: "the blue cup is in the bathroom".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "semantic/history/event.h"
#include "semantic/query/home_index.h"

namespace oikos::semantic {

struct Correction {
  std::string subject;  ///< id of a small object, a joint or a knob
  State after;
};

struct StatementReading {
  std::optional<Correction> correction;
  std::string sentence;  ///< what was understood, or why nothing was
};

/// "X is on / in / under Y", "I put X on Y", "X is closed", "X is set to S", "X is off". X has to be one thing; where on Y it lies, nobody
/// said: the middle of Y is taken. Never throws. Thread-safe.
[[nodiscard]] StatementReading readStatement(const HomeIndex& index, std::string_view statement);

}  // namespace oikos::semantic
