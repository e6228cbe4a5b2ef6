// SPDX-License-Identifier: Apache-2.0
// Events and files as history.sqlite holds them.
#pragma once

#include <cstdint>
#include <string>

#include "semantic/history/event.h"
#include "semantic/history/sqlite.h"

namespace oikos::semantic {

/// Of a row with the columns number, time_ns, recording, frame, subject, kind, before, after, confidence, evidence. Throws Error{kInput}
/// for what this program does not know; `file` is named then.
[[nodiscard]] Event eventOf(const SqliteStatement& row, const std::string& file);

/// As the parameters of the same columns. The event's own number is left out of account.
void bindEvent(SqliteStatement& statement, const Event& event, std::int64_t number);

[[nodiscard]] std::string deflated(const std::string& content);
/// `size`: of the content. Throws Error{kInput}.
[[nodiscard]] std::string inflated(const std::string& bytes, std::size_t size, const std::string& file);

}  // namespace oikos::semantic
