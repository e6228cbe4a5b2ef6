// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/history.h"

#include <algorithm>
#include <mutex>

#include "core/base/error.h"
#include "semantic/history/history_rows.h"
#include "semantic/history/history_sql.h"
#include "semantic/history/sqlite.h"

namespace oikos::semantic {

namespace {

/// Every statement that reads, on one connection.
struct Reads {
  explicit Reads(SqliteDatabase& database)
      : last_number(database, history_sql::lastNumber()),
        after_number(database, history_sql::eventsAfter()),
        of_subject(database, history_sql::eventsOf()),
        last_of_subject(database, history_sql::lastEventsOf()),
        between(database, history_sql::eventsBetween()),
        count_between(database, history_sql::countBetween()),
        state_at(database, history_sql::stateAt()),
        state_after(database, history_sql::stateAfter()),
        sighting_at(database, history_sql::sightingAt()),
        of_recording(database, history_sql::eventsOfRecording()),
        state_without(database, history_sql::stateWithout()),
        first_state(database, history_sql::firstState()),
        next_subject(database, history_sql::nextSubject()),
        next_recording(database, history_sql::nextRecording()),
        last_recording(database, history_sql::lastRecording()),
        span_of_recording(database, history_sql::spanOfRecording()),
        last_read_recording(database, history_sql::lastReadRecording(database)),
        checkpoints(database, history_sql::checkpoints()) {}

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
  SqliteStatement last_read_recording;
  SqliteStatement checkpoints;
};

/// As SQLite counts: no more than an int64_t holds.
std::int64_t countOf(std::size_t number) {
  return static_cast<std::int64_t>(std::min<std::size_t>(number, std::numeric_limits<std::int64_t>::max()));
}

/// The values of a column in their order: `next` finds the first above its parameter. One look into the index a value, however many rows
/// have it.
std::vector<std::string> eachOnce(SqliteStatement& next) {
  std::vector<std::string> values;
  for (std::string last;;) {
    const SqliteUse use(next, std::string_view(last));
    if (!use->step()) {
      return values;
    }
    last = use->text(0);
    values.push_back(last);
  }
}

class Writer {
 public:
  explicit Writer(const std::filesystem::path& file)
      : database_(openHistoryForWriting(file)),
        insert_(database_, "INSERT INTO event VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        last_(database_, "SELECT max(number) FROM event"),
        find_read_(database_, history_sql::readRecording()),
        insert_read_(database_, "INSERT OR REPLACE INTO tracked_recording VALUES(?, ?, ?, ?, ?)") {}

  /// All or none; the last number.
  std::int64_t append(std::span<const Event> events, const History::Checkpoint* checkpoint, const std::string& deflated_home) {
    SqliteTransaction transaction(database_);
    const std::int64_t number = insert(events);
    if (checkpoint != nullptr) {
      add(*checkpoint, deflated_home);
    }
    transaction.commit();
    return number;
  }

  std::optional<std::int64_t> appendRecording(const History::ReadRecording& read, std::span<const Event> events) {
    SqliteTransaction transaction(database_);
    if (const auto before = findRead(read.digest); before && before->counts) {
      return std::nullopt;
    }
    const std::int64_t number = insert(events);
    {
      const SqliteUse use(insert_read_, std::string_view(read.digest), std::string_view(read.recording), number, read.first_ns,
                          read.last_ns);
      use->step();
    }
    transaction.commit();
    return number;
  }

  std::optional<History::ReadBefore> findRead(std::string_view digest) {
    const SqliteUse use(find_read_, digest);
    return use->step() ? std::optional(History::ReadBefore{use->text(0), use->integer(1) == 0}) : std::nullopt;
  }

 private:
  std::int64_t insert(std::span<const Event> events) {
    std::int64_t number = lastNumber();
    for (const Event& event : events) {
      const SqliteUse use(insert_);
      bindEvent(*use, event, ++number);
      use->step();
    }
    return number;
  }

  std::int64_t lastNumber() {
    const SqliteUse use(last_);
    return use->step() ? use->integer(0) : 0;
  }

  void add(const History::Checkpoint& checkpoint, const std::string& deflated_home) {
    SqliteStatement statement(database_, "INSERT INTO checkpoint(as_of, size, home_xml_deflated) VALUES(?, ?, ?)");
    statement.bind(1, checkpoint.as_of);
    statement.bind(2, static_cast<std::int64_t>(checkpoint.content.size()));
    statement.bindBlob(3, deflated_home);
    statement.step();
    database_.execute("DELETE FROM checkpoint WHERE id <= (SELECT max(id) FROM checkpoint) - 2");
  }

  SqliteDatabase database_;
  SqliteStatement insert_;
  SqliteStatement last_;
  SqliteStatement find_read_;
  SqliteStatement insert_read_;
};

}  // namespace

/// One connection to write, one to read; each is used by one thread at a time.
class History::Database {
 public:
  Database(std::filesystem::path file, HistoryAccess access) : file_(std::move(file)) {
    if (access == HistoryAccess::kAppend) {
      writer_.emplace(file_);
    }
  }

  std::int64_t append(std::span<const Event> events, const Checkpoint* checkpoint) {
    OIKOS_CHECK(writer_.has_value());
    const std::string deflated_home = checkpoint == nullptr ? "" : deflated(checkpoint->content);
    const std::lock_guard lock(writer_mutex_);
    return writer_->append(events, checkpoint, deflated_home);
  }

  /// `write(writer)`.
  template <class Write>
  auto write(const Write& write) {
    OIKOS_CHECK(writer_.has_value());
    const std::lock_guard lock(writer_mutex_);
    return write(*writer_);
  }

  /// `read(reads)`, or an empty value as long as there is no file.
  template <class Read>
  auto read(const Read& read) -> decltype(read(std::declval<Reads&>())) {
    const std::lock_guard lock(reads_mutex_);
    if (!reads_) {
      open();
    }
    if (!reads_) {
      return {};
    }
    return read(*reads_);
  }

  /// What the statement finds with these parameters.
  template <class... Values>
  std::vector<Event> all(SqliteStatement Reads::*statement, Values... values) {
    return read([&](Reads& reads) {
      const SqliteUse use(reads.*statement, values...);
      std::vector<Event> events;
      while (use->step()) {
        events.push_back(eventOf(*use, file_.string()));
      }
      return events;
    });
  }

  /// The first of that.
  template <class... Values>
  std::optional<Event> one(SqliteStatement Reads::*statement, Values... values) {
    return read([&](Reads& reads) {
      const SqliteUse use(reads.*statement, values...);
      return use->step() ? std::optional(eventOf(*use, file_.string())) : std::nullopt;
    });
  }

  /// Of a statement that finds a number or nothing.
  template <class... Values>
  std::int64_t number(SqliteStatement Reads::*statement, Values... values) {
    return read([&](Reads& reads) {
      const SqliteUse use(reads.*statement, values...);
      return use->step() ? use->integer(0) : std::int64_t{0};
    });
  }

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  /// If there is a history to read.
  void open() {
    if (!std::filesystem::exists(file_)) {
      return;
    }
    database_.emplace(file_, SqliteDatabase::Mode::kRead);
    if (database_->pragma("schema_version") == 0) {  // somebody is about to make it
      database_.reset();
      return;
    }
    checkHistoryFormat(*database_);
    reads_.emplace(*database_);
  }

  const std::filesystem::path file_;
  std::mutex writer_mutex_;  // of:
  std::optional<Writer> writer_;
  std::mutex reads_mutex_;  // of:
  std::optional<SqliteDatabase> database_;
  std::optional<Reads> reads_;
};

History::History(const std::filesystem::path& file, HistoryAccess access) : database_(std::make_unique<Database>(file, access)) {}

History::~History() = default;

std::int64_t History::append(std::span<const Event> events, const Checkpoint* checkpoint) {
  return database_->append(events, checkpoint);
}

std::optional<std::int64_t> History::appendRecording(const ReadRecording& read, std::span<const Event> events) {
  return database_->write([&](Writer& writer) { return writer.appendRecording(read, events); });
}

std::optional<History::ReadBefore> History::findReadRecording(std::string_view digest) const {
  return database_->write([&](Writer& writer) { return writer.findRead(digest); });
}

std::int64_t History::lastNumber() const {
  return database_->number(&Reads::last_number);
}

std::vector<Event> History::eventsAfter(std::int64_t number, std::size_t limit) const {
  return database_->all(&Reads::after_number, number, countOf(limit));
}

std::vector<Event> History::eventsOf(std::string_view subject) const {
  return database_->all(&Reads::of_subject, subject);
}

std::vector<Event> History::lastEventsOf(std::string_view subject, std::int64_t time_ns, std::size_t limit) const {
  std::vector<Event> events = database_->all(&Reads::last_of_subject, subject, time_ns, countOf(limit));
  std::reverse(events.begin(), events.end());
  return events;
}

std::vector<Event> History::eventsBetween(const Window& window) const {
  return database_->all(&Reads::between, window.from_ns, window.to_ns, countOf(window.limit), countOf(window.offset));
}

std::size_t History::countBetween(std::int64_t from_ns, std::int64_t to_ns) const {
  return static_cast<std::size_t>(database_->number(&Reads::count_between, from_ns, to_ns));
}

std::optional<Event> History::findStateAt(std::string_view subject, std::int64_t time_ns) const {
  return database_->one(&Reads::state_at, subject, time_ns);
}

std::optional<Event> History::findStateAfter(std::string_view subject, std::int64_t time_ns) const {
  return database_->one(&Reads::state_after, subject, time_ns);
}

std::optional<Event> History::findSightingAt(std::string_view subject, std::int64_t time_ns) const {
  return database_->one(&Reads::sighting_at, subject, time_ns);
}

std::vector<Event> History::eventsOfRecording(std::string_view recording) const {
  return database_->all(&Reads::of_recording, recording);
}

std::optional<Event> History::findStateWithout(std::string_view subject, std::string_view recording) const {
  return database_->one(&Reads::state_without, subject, recording);
}

std::optional<Event> History::findFirstState(std::string_view subject) const {
  return database_->one(&Reads::first_state, subject);
}

std::vector<std::string> History::subjects() const {
  return database_->read([](Reads& reads) { return eachOnce(reads.next_subject); });
}

std::vector<std::string> History::recordings() const {
  return database_->read([](Reads& reads) { return eachOnce(reads.next_recording); });
}

std::optional<History::RecordingSpan> History::findLastRecording() const {
  return database_->read([](Reads& reads) -> std::optional<RecordingSpan> {
    std::optional<RecordingSpan> span;
    if (const SqliteUse last(reads.last_recording); last->step()) {
      span = RecordingSpan{last->text(0), 0, 0};
      const SqliteUse use(reads.span_of_recording, std::string_view(span->recording));
      OIKOS_CHECK(use->step());
      span->first_ns = use->integer(0);
      span->last_ns = use->integer(1);
    }
    const SqliteUse read(reads.last_read_recording);
    if (read->step() && (!span || read->integer(2) >= span->last_ns)) {
      span = RecordingSpan{read->text(0), read->integer(1), read->integer(2)};
    }
    return span;
  });
}

std::vector<History::Checkpoint> History::checkpoints() const {
  return database_->read([&](Reads& reads) {
    std::vector<Checkpoint> found;
    const SqliteUse use(reads.checkpoints);
    while (use->step()) {
      found.push_back({use->integer(0), inflated(use->text(2), static_cast<std::size_t>(use->integer(1)), database_->file().string())});
    }
    return found;
  });
}

}  // namespace oikos::semantic
