// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/sqlite.h"

#include <sqlite3.h>

#include <string>
#include <system_error>
#include <utility>

#include "core/base/error.h"

namespace oikos::semantic {

namespace {

constexpr int kBusy_ms = 10000;

int primaryOf(int code) {
  return code & 0xFF;
}

bool isDamaged(int code) {
  return primaryOf(code) == SQLITE_NOTADB || primaryOf(code) == SQLITE_CORRUPT;
}

}  // namespace

void SqliteDatabase::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

SqliteDatabase::SqliteDatabase(std::filesystem::path file, Mode mode) : file_(std::move(file)) {
  if (mode == Mode::kWrite) {
    open(file_.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    return;
  }
  open(file_.string(), SQLITE_OPEN_READONLY);
  const int code = sqlite3_exec(get(), "PRAGMA schema_version", nullptr, nullptr, nullptr);
  if (sqlite3_extended_errcode(get()) == SQLITE_READONLY_ROLLBACK) {
    open(file_.string(), SQLITE_OPEN_READWRITE);  // what was cut off before it counted has to be undone first
  } else if (primaryOf(code) == SQLITE_CANTOPEN || primaryOf(code) == SQLITE_READONLY) {
    openWhereNothingCanBeWritten();
  }
}

/// The log's index cannot be shared there; but nobody else writes either.
void SqliteDatabase::openWhereNothingCanBeWritten() {
  const std::filesystem::path log = file_.string() + "-wal";
  std::error_code none;
  if (const auto size = std::filesystem::file_size(log, none); !none && size > 0) {
    throw base::Error(
        base::ErrorCode::kIo,
        "what came last is still in this log, which cannot be taken in where nothing may be written: open it where that may be, "
        "or copy both files there",
        log.string());
  }
  open("file:" + file_.string() + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
}

void SqliteDatabase::open(const std::string& name, int flags) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) {
    fail(code);
  }
  sqlite3_busy_timeout(opened, kBusy_ms);
}

void SqliteDatabase::fail(int code) const {
  if (primaryOf(code) == SQLITE_READONLY) {
    throw base::Error(base::ErrorCode::kIo, "may not be written: the file, its folder or its file system is read-only", file_.string());
  }
  const std::string what = database_ ? sqlite3_errmsg(database_.get()) : sqlite3_errstr(code);
  throw base::Error(isDamaged(code) ? base::ErrorCode::kInput : base::ErrorCode::kIo, what, file_.string());
}

void SqliteDatabase::execute(const char* sql) {
  const int code = sqlite3_exec(get(), sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) {
    fail(code);
  }
}

std::int64_t SqliteDatabase::pragma(const char* name) {
  SqliteStatement statement(*this, std::string("PRAGMA ") + name);
  return statement.step() ? statement.integer(0) : 0;
}

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteStatement::SqliteStatement(SqliteDatabase& database, const std::string& sql) : database_(database) {
  sqlite3_stmt* prepared = nullptr;
  const int code =
      sqlite3_prepare_v3(database.get(), sql.c_str(), static_cast<int>(sql.size()), SQLITE_PREPARE_PERSISTENT, &prepared, nullptr);
  statement_.reset(prepared);
  check(code);
}

void SqliteStatement::check(int code) const {
  if (code != SQLITE_OK && code != SQLITE_ROW && code != SQLITE_DONE) {
    database_.fail(code);
  }
}

void SqliteStatement::bind(int place, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), place, value));
}

void SqliteStatement::bind(int place, double value) {
  check(sqlite3_bind_double(statement_.get(), place, value));
}

void SqliteStatement::bind(int place, std::string_view text) {
  const char* const begin = text.data() == nullptr ? "" : text.data();
  check(sqlite3_bind_text64(statement_.get(), place, begin, text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}

void SqliteStatement::bindBlob(int place, std::string_view bytes) {
  check(sqlite3_bind_blob64(statement_.get(), place, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
}

void SqliteStatement::bindNull(int place) {
  check(sqlite3_bind_null(statement_.get(), place));
}

bool SqliteStatement::step() {
  const int code = sqlite3_step(statement_.get());
  check(code);
  return code == SQLITE_ROW;
}

void SqliteStatement::reset() {
  sqlite3_reset(statement_.get());  // says again what step() has thrown already
}

bool SqliteStatement::isNull(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::int64_t SqliteStatement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double SqliteStatement::real(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

std::string SqliteStatement::text(int column) const {
  const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  return bytes == nullptr ? std::string() : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)));
}

SqliteTransaction::SqliteTransaction(SqliteDatabase& database) : database_(database) {
  database_.execute("BEGIN IMMEDIATE");
}

SqliteTransaction::~SqliteTransaction() {
  if (open_) {
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);  // SQLite may have done it already, then this says so
  }
}

void SqliteTransaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

}  // namespace oikos::semantic
