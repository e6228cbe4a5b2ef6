// SPDX-License-Identifier: Apache-2.0
#include "tests/support/question_table.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>

#include "core/base/rfc3339.h"
#include "tests/support/event_list.h"

namespace oikos::test {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::set<std::string> idsOf(const semantic::Answer& answer) {
  std::set<std::string> ids;
  for (const semantic::FoundThing& found : answer.found) {
    ids.insert(found.id);
  }
  return ids;
}

bool statusFits(const std::string& status, const nlohmann::json& expected) {
  return expected.is_array() ? std::find(expected.begin(), expected.end(), status) != expected.end() : expected == status;
}

}  // namespace

QuestionedHome::QuestionedHome(const std::filesystem::path& source_folder, const std::string& name, const std::filesystem::path& events) {
  std::filesystem::copy_file(source_folder / "homes" / name / "home.xml", folder_.path() / "home.xml");
  store_ = std::make_unique<semantic::HomeStore>(folder_.path(), [] { return base::parseRfc3339Ns("2026-03-01T00:00:00Z").value(); });
  if (!events.empty()) {
    store_->append(readEvents(events.string()));
  }
  const auto snapshot = store_->snapshot();
  index_ = std::make_unique<semantic::HomeIndex>(std::shared_ptr<const semantic::Home>(snapshot, &snapshot->home));
}

semantic::Answer QuestionedHome::ask(const std::string& question, std::int64_t now_ns) const {
  return semantic::answerQuestion({index_.get(), &store_->history(), now_ns, std::nullopt, &store_->recollection()}, question);
}

std::vector<TableRow> readTable(const std::filesystem::path& file) {
  std::ifstream input(file);
  std::vector<TableRow> rows;
  for (const nlohmann::json& row : nlohmann::json::parse(input)) {
    rows.push_back({row.at("home"), row.at("now"), row.at("question"), row.at("expect")});
  }
  return rows;
}

std::string missesOf(const semantic::Answer& answer, const nlohmann::json& expect) {
  const std::string status(base::toString(answer.status));
  if (expect.contains("status") && !statusFits(status, expect["status"])) {
    return "status";
  }
  if (expect.contains("found") && idsOf(answer) != expect["found"].get<std::set<std::string>>()) {
    return "found";
  }
  if (expect.contains("count") && (!answer.count || *answer.count != expect["count"].get<std::size_t>())) {
    return "count";
  }
  if (expect.contains("yes") && (!answer.yes || *answer.yes != expect["yes"].get<bool>())) {
    return "yes";
  }
  for (const nlohmann::json& piece : expect.value("says", nlohmann::json::array())) {
    if (lower(answer.sentence).find(lower(piece.get<std::string>())) == std::string::npos) {
      return "says";
    }
  }
  return {};
}

TableScore score(const std::vector<TableRow>& table, const std::filesystem::path& source_folder, bool with_events) {
  const std::filesystem::path events = source_folder / "tests/data/questions/demo_events.jsonl";
  std::map<std::string, std::unique_ptr<QuestionedHome>> homes;
  TableScore result;
  for (const TableRow& row : table) {
    auto& home = homes[row.home];
    if (!home) {
      home = std::make_unique<QuestionedHome>(source_folder, row.home, with_events && row.home == "household" ? events : "");
    }
    const semantic::Answer answer = home->ask(row.question, base::parseRfc3339Ns(row.now).value());
    const std::string miss = missesOf(answer, row.expect);
    if (miss.empty()) {
      ++result.right;
      continue;
    }
    std::string ids;
    for (const std::string& id : idsOf(answer)) {
      ids += " " + id;
    }
    const std::string report = row.question + "\n   " + std::string(base::toString(answer.status)) + ": " + answer.sentence +
                               "\n   found:" + ids + "\n   expected (" + miss + " is wrong): " + row.expect.dump();
    result.failures.push_back(report);
    if (answer.status == semantic::AnswerStatus::kAnswered) {
      result.confident.push_back(report);
    }
  }
  return result;
}

}  // namespace oikos::test
