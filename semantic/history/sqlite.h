// SPDX-License-Identifier: Apache-2.0
// SQLite with its errors turned into ours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

struct sqlite3;
struct sqlite3_stmt;

namespace oikos::semantic {

/// One connection. Throws Error{kIo} where the file cannot be read or written (no space, no permission, busy for 10 s), Error{kInput} where
/// it is no database. kRead works where nothing may be written, too, unless the last writer was killed and its log is still to be taken in;
/// a database whose making was cut off is put in order first. Not thread-safe.
class SqliteDatabase {
 public:
  enum class Mode { kRead, kWrite };
  SqliteDatabase(std::filesystem::path file, Mode mode);

  void execute(const char* sql);
  [[nodiscard]] std::int64_t pragma(const char* name);
  [[nodiscard]] sqlite3* get() const { return database_.get(); }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[noreturn]] void fail(int code) const;

 private:
  void open(const std::string& name, int flags);
  void openWhereNothingCanBeWritten();

  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// A prepared statement, to be used again and again: bind all, step until there is no row, reset. The database must outlive it.
class SqliteStatement {
 public:
  SqliteStatement(SqliteDatabase& database, const std::string& sql);

  void bind(int place, std::int64_t value);
  void bind(int place, double value);
  void bind(int place, std::string_view text);  ///< copied; empty text is stored as such
  void bindBlob(int place, std::string_view bytes);
  void bindNull(int place);
  /// Whether there is a row.
  bool step();
  void reset();

  [[nodiscard]] bool isNull(int column) const;
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double real(int column) const;
  [[nodiscard]] std::string text(int column) const;  ///< bytes of a text or blob

 private:
  void check(int code) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  SqliteDatabase& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A statement with its parameters, which is reset at the end so that it can be used again whatever happened.
class SqliteUse {
 public:
  template <class... Values>
  explicit SqliteUse(SqliteStatement& statement, Values... values) : statement_(statement) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (statement.bind(static_cast<int>(I) + 1, values), ...);
    }
    (std::index_sequence_for<Values...>());
  }
  ~SqliteUse() { statement_.reset(); }
  SqliteUse(const SqliteUse&) = delete;
  SqliteUse& operator=(const SqliteUse&) = delete;
  SqliteStatement* operator->() const { return &statement_; }
  SqliteStatement& operator*() const { return statement_; }

 private:
  SqliteStatement& statement_;
};

/// All that is done until commit(), or nothing.
class SqliteTransaction {
 public:
  explicit SqliteTransaction(SqliteDatabase& database);
  ~SqliteTransaction();
  SqliteTransaction(const SqliteTransaction&) = delete;
  SqliteTransaction& operator=(const SqliteTransaction&) = delete;
  void commit();

 private:
  SqliteDatabase& database_;
  bool open_ = true;
};

}  // namespace oikos::semantic
