// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/history_sql.h"

#include <initializer_list>
#include <string_view>

#include "core/base/error.h"

namespace oikos::semantic {

namespace {

constexpr std::int64_t kApplicationId = 0x4F494B48;  // "OIKH"
constexpr std::int64_t kVersion = 1;

constexpr const char* kSchema =
    "CREATE TABLE event(number INTEGER PRIMARY KEY, time_ns INTEGER NOT NULL, recording TEXT, frame INTEGER, subject TEXT NOT NULL,"
    " kind TEXT NOT NULL, before TEXT, after TEXT, confidence REAL NOT NULL, evidence TEXT);"
    "CREATE INDEX event_of_subject ON event(subject, time_ns, number);"
    "CREATE INDEX state_of_subject ON event(subject, time_ns, number) WHERE after IS NOT NULL AND kind NOT IN ('missed', 'forgotten');"
    "CREATE INDEX event_of_time ON event(time_ns, number);"
    "CREATE INDEX event_of_recording ON event(recording, time_ns) WHERE recording IS NOT NULL;"
    "CREATE INDEX taken_back ON event(recording, number) WHERE kind = 'reverted';"
    "CREATE INDEX evidence_forgotten ON event(evidence, number) WHERE kind = 'forgotten';"
    "CREATE TRIGGER no_update BEFORE UPDATE ON event BEGIN SELECT RAISE(ABORT, 'a history is never changed'); END;"
    "CREATE TRIGGER no_delete BEFORE DELETE ON event BEGIN SELECT RAISE(ABORT, 'a history is never changed'); END;"
    "CREATE TABLE checkpoint(id INTEGER PRIMARY KEY, as_of INTEGER NOT NULL, size INTEGER NOT NULL, home_xml_deflated BLOB NOT NULL);";

/// A lookup among sightings alone: a joint's or cup's other events may be many. And which recordings were read, with the last event there
/// was then and the times of their first and last frame. Programs that do not know these keep them.
constexpr const char* kLater =
    "CREATE INDEX IF NOT EXISTS sighting_of_subject ON event(subject, time_ns, number) WHERE kind = 'sighted' AND after IS NOT NULL;"
    "CREATE TABLE IF NOT EXISTS tracked_recording(digest TEXT PRIMARY KEY, recording TEXT NOT NULL, last_event INTEGER NOT NULL,"
    " first_ns INTEGER NOT NULL, last_ns INTEGER NOT NULL);";

constexpr std::string_view kSaysState = "e.after IS NOT NULL AND e.kind NOT IN ('missed', 'forgotten')";
/// Not taken back.
constexpr std::string_view kCounts =
    "(e.recording IS NULL OR e.kind = 'reverted' OR NOT EXISTS"
    " (SELECT 1 FROM event r WHERE r.kind = 'reverted' AND r.recording = e.recording AND r.number > e.number))";

/// Of a recording that was read.
constexpr std::string_view kTakenBack =
    "EXISTS (SELECT 1 FROM event r WHERE r.kind = 'reverted' AND r.recording = t.recording AND r.number > t.last_event)";

constexpr std::string_view kNewestOne = "ORDER BY e.time_ns DESC, e.number DESC LIMIT 1";

/// `what` of the events that fit all conditions; `rest`: order and limit.
std::string select(std::string_view what, std::initializer_list<std::string_view> conditions, std::string_view rest) {
  std::string sql = "SELECT " + std::string(what) + " FROM event e WHERE 1";
  for (const std::string_view condition : conditions) {
    sql.append(" AND ").append(condition);
  }
  return sql.append(" ").append(rest);
}

constexpr std::string_view kUpToAfter =
    ", e.after, e.confidence,"
    " CASE WHEN e.kind = 'forgotten' OR NOT EXISTS"
    " (SELECT 1 FROM event f WHERE f.kind = 'forgotten' AND f.evidence = e.evidence AND f.number > e.number) THEN e.evidence END";

std::string wholeEvent() {
  return "e.number, e.time_ns, e.recording, e.frame, e.subject, e.kind, e.before" + std::string(kUpToAfter);
}

std::string withoutBefore() {
  return "e.number, e.time_ns, e.recording, e.frame, e.subject, e.kind, NULL" + std::string(kUpToAfter);
}

}  // namespace

void checkHistoryFormat(SqliteDatabase& database) {
  const std::int64_t id = database.pragma("application_id");
  const std::int64_t version = database.pragma("user_version");
  if (id != kApplicationId) {
    throw base::Error(base::ErrorCode::kInput, "an SQLite file, but no history of a home", database.file().string());
  }
  if (version > kVersion) {
    throw base::Error(base::ErrorCode::kInput,
                      "version " + std::to_string(version) + " of a history; this program reads up to " + std::to_string(kVersion),
                      database.file().string());
  }
}

SqliteDatabase openHistoryForWriting(const std::filesystem::path& file) {
  SqliteDatabase database(file, SqliteDatabase::Mode::kWrite);
  database.execute("PRAGMA journal_mode=WAL");
  database.execute("PRAGMA synchronous=FULL");
  SqliteTransaction transaction(database);
  if (database.pragma("application_id") == 0 && database.pragma("schema_version") == 0) {
    database.execute(kSchema);
    database.execute(("PRAGMA application_id=" + std::to_string(kApplicationId)).c_str());
    database.execute(("PRAGMA user_version=" + std::to_string(kVersion)).c_str());
  }
  checkHistoryFormat(database);
  database.execute(kLater);
  transaction.commit();
  return database;
}

namespace history_sql {

std::string lastNumber() {
  return select("max(e.number)", {}, "");
}

std::string eventsAfter() {
  return select(wholeEvent(), {"e.number > ?"}, "ORDER BY e.number LIMIT ?");
}

std::string eventsOf() {
  return select(wholeEvent(), {"e.subject = ?", kCounts}, "ORDER BY e.time_ns, e.number");
}

std::string lastEventsOf() {
  return select(withoutBefore(), {"e.subject = ?", "e.time_ns <= ?", kCounts}, "ORDER BY e.time_ns DESC, e.number DESC LIMIT ?");
}

std::string eventsBetween() {
  return select(wholeEvent(), {"e.time_ns >= ?", "e.time_ns < ?", kCounts}, "ORDER BY e.time_ns, e.number LIMIT ? OFFSET ?");
}

std::string countBetween() {
  return select("count(*)", {"e.time_ns >= ?", "e.time_ns < ?", kCounts}, "");
}

std::string stateAt() {
  return select(wholeEvent(), {"e.subject = ?", "e.time_ns <= ?", kSaysState, kCounts}, kNewestOne);
}

std::string stateAfter() {
  return select(wholeEvent(), {"e.subject = ?", "e.time_ns > ?", kSaysState, kCounts}, "ORDER BY e.time_ns, e.number LIMIT 1");
}

std::string sightingAt() {
  return select(wholeEvent(), {"e.subject = ?", "e.time_ns <= ?", "e.kind = 'sighted'", "e.after IS NOT NULL", kCounts}, kNewestOne);
}

std::string eventsOfRecording() {
  return select(wholeEvent(), {"e.recording = ?", "e.kind != 'reverted'", kCounts}, "ORDER BY e.number");
}

std::string stateWithout() {
  return select(wholeEvent(), {"e.subject = ?", "e.recording IS NOT ?", "e.kind != 'reverted'", kSaysState, kCounts}, kNewestOne);
}

std::string firstState() {
  return select(wholeEvent(), {"e.subject = ?", kSaysState}, "ORDER BY e.number LIMIT 1");
}

std::string nextSubject() {
  return select("e.subject", {"e.subject > ?", kSaysState}, "ORDER BY e.subject LIMIT 1");
}

std::string nextRecording() {
  return select("e.recording", {"e.recording > ?"}, "ORDER BY e.recording LIMIT 1");
}

std::string lastRecording() {
  return select("e.recording", {"e.recording IS NOT NULL", "e.kind != 'reverted'", kCounts}, kNewestOne);
}

std::string spanOfRecording() {
  return select("min(e.time_ns), max(e.time_ns)", {"e.recording = ?", "e.kind != 'reverted'", kCounts}, "");
}

std::string readRecording() {
  return "SELECT t.recording, " + std::string(kTakenBack) + " FROM tracked_recording t WHERE t.digest = ?";
}

std::string lastReadRecording(SqliteDatabase& database) {
  SqliteStatement tables(database, "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'tracked_recording'");
  if (const SqliteUse use(tables); !use->step()) {  // an older program's history
    return "SELECT '', 0, 0 WHERE 0";
  }
  return "SELECT t.recording, t.first_ns, t.last_ns FROM tracked_recording t WHERE NOT " + std::string(kTakenBack) +
         " ORDER BY t.last_ns DESC, t.last_event DESC, t.recording LIMIT 1";
}

std::string checkpoints() {
  return "SELECT as_of, size, home_xml_deflated FROM checkpoint ORDER BY id DESC";
}

}  // namespace history_sql

}  // namespace oikos::semantic
