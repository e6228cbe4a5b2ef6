// SPDX-License-Identifier: Apache-2.0
// The format of history.sqlite and every statement that reads it. An event counts unless a later event `reverted` takes its recording back;
// its evidence is left out once a later event `forgotten` names it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "semantic/history/sqlite.h"

namespace oikos::semantic {

/// Makes the tables where there are none yet, and what an older program did not make. Throws Error{kInput} for a file that is no
/// history or of a newer version, Error{kIo} where it cannot be written.
[[nodiscard]] SqliteDatabase openHistoryForWriting(const std::filesystem::path& file);

/// Throws as above.
void checkHistoryFormat(SqliteDatabase& database);

/// What a statement finds; `?`: its parameters in their order. Whole events have the columns that `history_rows.h` reads.
namespace history_sql {

[[nodiscard]] std::string lastNumber();
[[nodiscard]] std::string eventsAfter();        ///< number, limit
[[nodiscard]] std::string eventsOf();           ///< subject
[[nodiscard]] std::string lastEventsOf();       ///< subject, time_ns, limit; the newest first, without `before`
[[nodiscard]] std::string eventsBetween();      ///< from_ns, to_ns, limit, offset
[[nodiscard]] std::string countBetween();       ///< from_ns, to_ns
[[nodiscard]] std::string stateAt();            ///< subject, time_ns
[[nodiscard]] std::string stateAfter();         ///< subject, time_ns
[[nodiscard]] std::string sightingAt();         ///< subject, time_ns
[[nodiscard]] std::string eventsOfRecording();  ///< recording
[[nodiscard]] std::string stateWithout();       ///< subject, recording
[[nodiscard]] std::string firstState();         ///< subject
[[nodiscard]] std::string nextSubject();        ///< the subject before it
[[nodiscard]] std::string nextRecording();      ///< the recording before it
[[nodiscard]] std::string lastRecording();
[[nodiscard]] std::string spanOfRecording();  ///< recording; its first and last time_ns
[[nodiscard]] std::string readRecording();    ///< digest; its name, and whether it was taken back since
/// Its name, the times of its first and last frame.
[[nodiscard]] std::string lastReadRecording(SqliteDatabase& database);
[[nodiscard]] std::string checkpoints();  ///< as_of, size, home_xml_deflated; the newest first

}  // namespace history_sql

}  // namespace oikos::semantic
