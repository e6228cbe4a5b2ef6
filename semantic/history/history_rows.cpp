// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/history_rows.h"

#include <libdeflate.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "core/base/error.h"
#include "semantic/history/event_json.h"

namespace oikos::semantic {

namespace {

constexpr int kCompression = 1;  // home.xml of a large home is written every minute

std::optional<State> stateOf(const SqliteStatement& row, int column, const std::string& where) {
  if (row.isNull(column)) {
    return std::nullopt;
  }
  const nlohmann::json json = nlohmann::json::parse(row.text(column), nullptr, false);
  return stateFromJson(json, where);
}

void bindTextOrNull(SqliteStatement& statement, int place, const std::string& text) {
  text.empty() ? statement.bindNull(place) : statement.bind(place, std::string_view(text));
}

void bindState(SqliteStatement& statement, int place, const std::optional<State>& state) {
  state ? statement.bind(place, std::string_view(toJson(*state).dump())) : statement.bindNull(place);
}

}  // namespace

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

void bindEvent(SqliteStatement& statement, const Event& event, std::int64_t number) {
  statement.bind(1, number);
  statement.bind(2, event.time_ns);
  bindTextOrNull(statement, 3, event.recording);
  event.frame ? statement.bind(4, *event.frame) : statement.bindNull(4);
  statement.bind(5, std::string_view(event.subject));
  statement.bind(6, base::toString(event.kind));
  bindState(statement, 7, event.before);
  bindState(statement, 8, event.after);
  statement.bind(9, event.confidence);
  bindTextOrNull(statement, 10, event.evidence);
}

std::string deflated(const std::string& content) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(libdeflate_alloc_compressor(kCompression),
                                                                                                 &libdeflate_free_compressor);
  std::string out(libdeflate_deflate_compress_bound(compressor.get(), content.size()), '\0');
  out.resize(libdeflate_deflate_compress(compressor.get(), content.data(), content.size(), out.data(), out.size()));
  return out;
}

std::string inflated(const std::string& bytes, std::size_t size, const std::string& file) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(libdeflate_alloc_decompressor(),
                                                                                                       &libdeflate_free_decompressor);
  std::string out(size, '\0');
  if (libdeflate_deflate_decompress(decompressor.get(), bytes.data(), bytes.size(), out.data(), size, nullptr) != LIBDEFLATE_SUCCESS) {
    throw base::Error(base::ErrorCode::kInput, "a checkpoint that cannot be unpacked", file);
  }
  return out;
}

}  // namespace oikos::semantic
