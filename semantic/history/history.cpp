// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/history.h"

#include <libdeflate.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "semantic/history/event_json.h"
#include "semantic/history/sqlite.h"

namespace oikos::semantic {

namespace {

constexpr std::int64_t kApplicationId = 0x4F494B48;  // "OIKH"
constexpr std::int64_t kVersion = 1;
constexpr int kCompression = 1;  // home.xml of a large home is written every minute

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

constexpr std::string_view kSaysState = "e.after IS NOT NULL AND e.kind NOT IN ('missed', 'forgotten')";
/// Not taken back.
constexpr std::string_view kCounts =
    "(e.recording IS NULL OR e.kind = 'reverted' OR NOT EXISTS"
    " (SELECT 1 FROM event r WHERE r.kind = 'reverted' AND r.recording = e.recording AND r.number > e.number))";

/// `what` of the events that fit all conditions; `rest`: order and limit.
std::string select(std::string_view what, std::initializer_list<std::string_view> conditions, std::string_view rest) {
  std::string sql = "SELECT " + std::string(what) + " FROM event e WHERE 1";
  for (const std::string_view condition : conditions) {
    sql.append(" AND ").append(condition);
  }
  return sql.append(" ").append(rest);
}

constexpr std::string_view kWhole =
    "e.number, e.time_ns, e.recording, e.frame, e.subject, e.kind, e.before, e.after, e.confidence,"
    " CASE WHEN e.kind = 'forgotten' OR NOT EXISTS"
    " (SELECT 1 FROM event f WHERE f.kind = 'forgotten' AND f.evidence = e.evidence AND f.number > e.number) THEN e.evidence END";

std::string deflated(const std::string& content) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(libdeflate_alloc_compressor(kCompression),
                                                                                                 &libdeflate_free_compressor);
  std::string out(libdeflate_deflate_compress_bound(compressor.get(), content.size()), '\0');
  out.resize(libdeflate_deflate_compress(compressor.get(), content.data(), content.size(), out.data(), out.size()));
  return out;
}

std::string inflated(const std::string& bytes, std::size_t size, const std::filesystem::path& file) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(libdeflate_alloc_decompressor(),
                                                                                                       &libdeflate_free_decompressor);
  std::string out(size, '\0');
  if (libdeflate_deflate_decompress(decompressor.get(), bytes.data(), bytes.size(), out.data(), size, nullptr) != LIBDEFLATE_SUCCESS) {
    throw base::Error(base::ErrorCode::kInput, "a checkpoint that cannot be unpacked", file.string());
  }
  return out;
}

std::optional<State> stateOf(const SqliteStatement& row, int column, const std::string& where) {
  if (row.isNull(column)) {
    return std::nullopt;
  }
  const nlohmann::json json = nlohmann::json::parse(row.text(column), nullptr, false);
  return stateFromJson(json, where);
}

Event eventOf(const SqliteStatement& row, const std::string& file) {
  Event event;
  event.number = row.integer(0);
  const std::string where = file + ": event " + std::to_string(event.number);
  event.time_ns = row.integer(1);
  event.recording = row.text(2);
  event.frame = row.isNull(3) ? std::nullopt : std::optional(row.integer(3));
  event.subject = row.text(4);
  const auto kind = base::findEnum<EventKind>(row.text(5));
  if (!kind) {
    throw base::Error(base::ErrorCode::kInput, "kind '" + row.text(5) + "', which this program does not know", where);
  }
  event.kind = *kind;
  event.before = stateOf(row, 6, where);
  event.after = stateOf(row, 7, where);
  event.confidence = row.real(8);
  event.evidence = row.text(9);
  return event;
}

void bindTextOrNull(SqliteStatement& statement, int place, const std::string& text) {
  text.empty() ? statement.bindNull(place) : statement.bind(place, std::string_view(text));
}

void bindState(SqliteStatement& statement, int place, const std::optional<State>& state) {
  state ? statement.bind(place, std::string_view(toJson(*state).dump())) : statement.bindNull(place);
}

/// The values of a column in their order: `next` finds the first above its parameter. One look into the index a value, however many rows
/// have it.
std::vector<std::string> eachOnce(SqliteStatement& next) {
  std::vector<std::string> values;
  for (std::string last;;) {
    const SqliteUse use(next);
    use->bind(1, std::string_view(last));
    if (!use->step()) {
      return values;
    }
    last = use->text(0);
    values.push_back(last);
  }
}

void checkFormat(SqliteDatabase& database) {
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

/// Opens it, and makes it where there is none yet.
SqliteDatabase openForWriting(const std::filesystem::path& file) {
  SqliteDatabase database(file, SqliteDatabase::Mode::kWrite);
  database.execute("PRAGMA journal_mode=WAL");
  database.execute("PRAGMA synchronous=FULL");
  SqliteTransaction transaction(database);
  if (database.pragma("application_id") == 0 && database.pragma("schema_version") == 0) {
    database.execute(kSchema);
    database.execute(("PRAGMA application_id=" + std::to_string(kApplicationId)).c_str());
    database.execute(("PRAGMA user_version=" + std::to_string(kVersion)).c_str());
  }
  checkFormat(database);
  transaction.commit();
  return database;
}

}  // namespace

/// The statements of one connection; used by one thread at a time.
class History::Database {
 public:
  /// What is read, and only that.
  struct Reads {
    explicit Reads(SqliteDatabase& database)
        : last_number(database, select("max(e.number)", {}, "")),
          after_number(database, select(kWhole, {"e.number > ?"}, "ORDER BY e.number LIMIT ?")),
          of_subject(database, select(kWhole, {"e.subject = ?", kCounts}, "ORDER BY e.time_ns, e.number")),
          last_of_subject(database,
                          select(kWhole, {"e.subject = ?", "e.time_ns <= ?", kCounts}, "ORDER BY e.time_ns DESC, e.number DESC LIMIT ?")),
          between(database, select(kWhole, {"e.time_ns >= ?", "e.time_ns < ?", kCounts}, "ORDER BY e.time_ns, e.number LIMIT ? OFFSET ?")),
          count_between(database, select("count(*)", {"e.time_ns >= ?", "e.time_ns < ?", kCounts}, "")),
          state_at(database, select(kWhole, {"e.subject = ?", "e.time_ns <= ?", kSaysState, kCounts},
                                    "ORDER BY e.time_ns DESC, e.number DESC LIMIT 1")),
          state_after(database,
                      select(kWhole, {"e.subject = ?", "e.time_ns > ?", kSaysState, kCounts}, "ORDER BY e.time_ns, e.number LIMIT 1")),
          sighting_at(database, select(kWhole, {"e.subject = ?", "e.time_ns <= ?", "e.kind = 'sighted'", kSaysState, kCounts},
                                       "ORDER BY e.time_ns DESC, e.number DESC LIMIT 1")),
          of_recording(database, select(kWhole, {"e.recording = ?", "e.kind != 'reverted'", kCounts}, "ORDER BY e.number")),
          state_without(database, select(kWhole, {"e.subject = ?", "e.recording IS NOT ?", "e.kind != 'reverted'", kSaysState, kCounts},
                                         "ORDER BY e.time_ns DESC, e.number DESC LIMIT 1")),
          first_state(database, select(kWhole, {"e.subject = ?", kSaysState}, "ORDER BY e.number LIMIT 1")),
          next_subject(database, select("e.subject", {"e.subject > ?", kSaysState}, "ORDER BY e.subject LIMIT 1")),
          next_recording(database, select("e.recording", {"e.recording > ?"}, "ORDER BY e.recording LIMIT 1")),
          last_recording(database, select("e.recording", {"e.recording IS NOT NULL", "e.kind != 'reverted'", kCounts},
                                          "ORDER BY e.time_ns DESC, e.number DESC LIMIT 1")),
          span_of_recording(database, select("min(e.time_ns), max(e.time_ns)", {"e.recording = ?", "e.kind != 'reverted'", kCounts}, "")),
          checkpoints(database, "SELECT as_of, size, home_xml_deflated FROM checkpoint ORDER BY id DESC") {}

    SqliteStatement last_number;
    SqliteStatement after_number;
    SqliteStatement of_subject;
    SqliteStatement last_of_subject;
    SqliteStatement between;
    SqliteStatement count_between;
    SqliteStatement state_at;
    SqliteStatement state_after;
    SqliteStatement sighting_at;
    SqliteStatement of_recording;
    SqliteStatement state_without;
    SqliteStatement first_state;
    SqliteStatement next_subject;
    SqliteStatement next_recording;
    SqliteStatement last_recording;
    SqliteStatement span_of_recording;
    SqliteStatement checkpoints;
  };

  struct Writer {
    explicit Writer(const std::filesystem::path& file)
        : database(openForWriting(file)),
          insert(database, "INSERT INTO event VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
          last(database, "SELECT max(number) FROM event") {}

    std::int64_t lastNumber() {
      const SqliteUse use(last);
      return use->step() ? use->integer(0) : 0;
    }

    void add(const Event& event, std::int64_t number) {
      const SqliteUse use(insert);
      use->bind(1, number);
      use->bind(2, event.time_ns);
      bindTextOrNull(*use, 3, event.recording);
      event.frame ? use->bind(4, *event.frame) : use->bindNull(4);
      use->bind(5, std::string_view(event.subject));
      use->bind(6, base::toString(event.kind));
      bindState(*use, 7, event.before);
      bindState(*use, 8, event.after);
      use->bind(9, event.confidence);
      bindTextOrNull(*use, 10, event.evidence);
      use->step();
    }

    void add(const Checkpoint& checkpoint, const std::string& deflated_home) {
      SqliteStatement statement(database, "INSERT INTO checkpoint(as_of, size, home_xml_deflated) VALUES(?, ?, ?)");
      statement.bind(1, checkpoint.as_of);
      statement.bind(2, static_cast<std::int64_t>(checkpoint.content.size()));
      statement.bindBlob(3, deflated_home);
      statement.step();
      database.execute("DELETE FROM checkpoint WHERE id <= (SELECT max(id) FROM checkpoint) - 2");
    }

    std::mutex mutex;  // of everything here
    SqliteDatabase database;
    SqliteStatement insert;
    SqliteStatement last;
  };

  Database(std::filesystem::path file, HistoryAccess access) : file_(std::move(file)) {
    if (access == HistoryAccess::kAppend) {
      writer_.emplace(file_);
    }
  }

  Writer& writer() {
    OIKOS_CHECK(writer_.has_value());
    return *writer_;
  }

  /// `read(reads)` with the connection for reading, or `otherwise` as long as there is no file.
  template <class Read, class Value>
  Value withReads(const Read& read, Value otherwise) {
    const std::lock_guard lock(mutex_);
    if (!reads_) {
      if (!std::filesystem::exists(file_)) {
        return otherwise;
      }
      database_.emplace(file_, SqliteDatabase::Mode::kRead);
      if (database_->pragma("schema_version") == 0) {  // somebody is about to make it
        database_.reset();
        return otherwise;
      }
      checkFormat(*database_);
      reads_.emplace(*database_);
    }
    return read(*reads_);
  }

  std::vector<Event> allOf(SqliteStatement& statement) const {
    std::vector<Event> events;
    while (statement.step()) {
      events.push_back(eventOf(statement, file_.string()));
    }
    return events;
  }

  std::optional<Event> oneOf(SqliteStatement& statement) const {
    return statement.step() ? std::optional(eventOf(statement, file_.string())) : std::nullopt;
  }

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::optional<Writer> writer_;
  std::mutex mutex_;  // of what follows
  std::optional<SqliteDatabase> database_;
  std::optional<Reads> reads_;
};

History::History(const std::filesystem::path& file, HistoryAccess access) : database_(std::make_unique<Database>(file, access)) {}

History::~History() = default;

std::int64_t History::append(std::span<const Event> events, const Checkpoint* checkpoint) {
  const std::string deflated_home = checkpoint == nullptr ? "" : deflated(checkpoint->content);
  Database::Writer& writer = database_->writer();
  const std::lock_guard lock(writer.mutex);
  SqliteTransaction transaction(writer.database);
  std::int64_t number = writer.lastNumber();
  for (const Event& event : events) {
    writer.add(event, ++number);
  }
  if (checkpoint != nullptr) {
    writer.add(*checkpoint, deflated_home);
  }
  transaction.commit();
  return number;
}

std::int64_t History::lastNumber() const {
  return database_->withReads(
      [](Database::Reads& reads) {
        const SqliteUse use(reads.last_number);
        return use->step() ? use->integer(0) : std::int64_t{0};
      },
      std::int64_t{0});
}

std::vector<Event> History::eventsAfter(std::int64_t number, std::size_t limit) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.after_number);
        use->bind(1, number);
        use->bind(2, static_cast<std::int64_t>(std::min<std::size_t>(limit, std::numeric_limits<std::int64_t>::max())));
        return database_->allOf(*use);
      },
      std::vector<Event>());
}

std::vector<Event> History::eventsOf(std::string_view subject) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.of_subject);
        use->bind(1, subject);
        return database_->allOf(*use);
      },
      std::vector<Event>());
}

std::vector<Event> History::lastEventsOf(std::string_view subject, std::int64_t time_ns, std::size_t limit) const {
  std::vector<Event> events = database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.last_of_subject);
        use->bind(1, subject);
        use->bind(2, time_ns);
        use->bind(3, static_cast<std::int64_t>(limit));
        return database_->allOf(*use);
      },
      std::vector<Event>());
  std::reverse(events.begin(), events.end());
  return events;
}

std::vector<Event> History::eventsBetween(const Window& window) const {
  constexpr std::size_t kMost = std::numeric_limits<std::int64_t>::max();
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.between);
        use->bind(1, window.from_ns);
        use->bind(2, window.to_ns);
        use->bind(3, static_cast<std::int64_t>(std::min(window.limit, kMost)));
        use->bind(4, static_cast<std::int64_t>(std::min(window.offset, kMost)));
        return database_->allOf(*use);
      },
      std::vector<Event>());
}

std::size_t History::countBetween(std::int64_t from_ns, std::int64_t to_ns) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.count_between);
        use->bind(1, from_ns);
        use->bind(2, to_ns);
        return use->step() ? static_cast<std::size_t>(use->integer(0)) : 0U;
      },
      std::size_t{0});
}

std::optional<Event> History::findStateAt(std::string_view subject, std::int64_t time_ns) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.state_at);
        use->bind(1, subject);
        use->bind(2, time_ns);
        return database_->oneOf(*use);
      },
      std::optional<Event>());
}

std::optional<Event> History::findStateAfter(std::string_view subject, std::int64_t time_ns) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.state_after);
        use->bind(1, subject);
        use->bind(2, time_ns);
        return database_->oneOf(*use);
      },
      std::optional<Event>());
}

std::optional<Event> History::findSightingAt(std::string_view subject, std::int64_t time_ns) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.sighting_at);
        use->bind(1, subject);
        use->bind(2, time_ns);
        return database_->oneOf(*use);
      },
      std::optional<Event>());
}

std::vector<Event> History::eventsOfRecording(std::string_view recording) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.of_recording);
        use->bind(1, recording);
        return database_->allOf(*use);
      },
      std::vector<Event>());
}

std::optional<Event> History::findStateWithout(std::string_view subject, std::string_view recording) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.state_without);
        use->bind(1, subject);
        use->bind(2, recording);
        return database_->oneOf(*use);
      },
      std::optional<Event>());
}

std::optional<Event> History::findFirstState(std::string_view subject) const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        const SqliteUse use(reads.first_state);
        use->bind(1, subject);
        return database_->oneOf(*use);
      },
      std::optional<Event>());
}

std::vector<std::string> History::subjects() const {
  return database_->withReads([](Database::Reads& reads) { return eachOnce(reads.next_subject); }, std::vector<std::string>());
}

std::vector<std::string> History::recordings() const {
  return database_->withReads([](Database::Reads& reads) { return eachOnce(reads.next_recording); }, std::vector<std::string>());
}

std::optional<History::RecordingSpan> History::findLastRecording() const {
  return database_->withReads(
      [](Database::Reads& reads) -> std::optional<RecordingSpan> {
        const SqliteUse last(reads.last_recording);
        if (!last->step()) {
          return std::nullopt;
        }
        RecordingSpan span{last->text(0), 0, 0};
        const SqliteUse use(reads.span_of_recording);
        use->bind(1, std::string_view(span.recording));
        OIKOS_CHECK(use->step());
        span.first_ns = use->integer(0);
        span.last_ns = use->integer(1);
        return span;
      },
      std::optional<RecordingSpan>());
}

std::vector<History::Checkpoint> History::checkpoints() const {
  return database_->withReads(
      [&](Database::Reads& reads) {
        std::vector<Checkpoint> found;
        const SqliteUse use(reads.checkpoints);
        while (use->step()) {
          found.push_back({use->integer(0), inflated(use->text(2), static_cast<std::size_t>(use->integer(1)), database_->file())});
        }
        return found;
      },
      std::vector<Checkpoint>());
}

}  // namespace oikos::semantic
