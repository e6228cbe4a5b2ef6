// SPDX-License-Identifier: Apache-2.0
// SQLite as the keyframe store uses it; included by its sources only.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace oikos::mapping {

/// A prepared statement with its database's error turned into ours.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql, std::string where) : database_(database), where_(std::move(where)) {
    check(sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr));
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(Statement&& other) noexcept
      : database_(other.database_), where_(std::move(other.where_)), statement_(std::exchange(other.statement_, nullptr)) {}
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int index, std::int64_t value) { check(sqlite3_bind_int64(statement_, index, value)); }
  void bind(int index, double value) { check(sqlite3_bind_double(statement_, index, value)); }
  void bind(int index, const char* text) { check(sqlite3_bind_text(statement_, index, text, -1, SQLITE_TRANSIENT)); }
  void bind(int index, const std::vector<unsigned char>& blob) {
    check(sqlite3_bind_blob64(statement_, index, blob.empty() ? reinterpret_cast<const unsigned char*>("") : blob.data(), blob.size(),
                              SQLITE_TRANSIENT));
  }
  /// True while there is a row.
  bool step() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) {
      check(code);
    }
    return code == SQLITE_ROW;
  }
  [[nodiscard]] std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  [[nodiscard]] double real(int column) const { return sqlite3_column_double(statement_, column); }
  [[nodiscard]] std::string text(int column) const {
    const auto* characters = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return characters == nullptr ? std::string() : std::string(characters);
  }
  [[nodiscard]] std::vector<unsigned char> blob(int column) const {
    const auto* begin = static_cast<const unsigned char*>(sqlite3_column_blob(statement_, column));
    const int size = sqlite3_column_bytes(statement_, column);
    return begin == nullptr ? std::vector<unsigned char>{} : std::vector<unsigned char>(begin, begin + size);
  }

 private:
  void check(int code) const {
    if (code != SQLITE_OK) {
      const bool damaged = code == SQLITE_NOTADB || code == SQLITE_CORRUPT || code == SQLITE_ERROR;
      throw base::Error(damaged ? base::ErrorCode::kInput : base::ErrorCode::kIo, sqlite3_errmsg(database_), where_);
    }
  }
  sqlite3* database_;
  std::string where_;
  sqlite3_stmt* statement_ = nullptr;
};

inline void execute(sqlite3* database, const char* sql, const std::filesystem::path& file) {
  if (sqlite3_exec(database, sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
    throw base::Error(base::ErrorCode::kIo, sqlite3_errmsg(database), file.string());
  }
}

}  // namespace oikos::mapping
