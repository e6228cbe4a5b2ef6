// SPDX-License-Identifier: Apache-2.0
// Tables of questions with the answers that are right: tests/data/questions.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "semantic/history/home_store.h"
#include "semantic/query/answer.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {

/// A sample home in a folder of its own, with the events of its table.
class QuestionedHome {
 public:
  /// `name`: of a folder below homes/; `events`: a file of JSON lines, empty: none.
  QuestionedHome(const std::filesystem::path& source_folder, const std::string& name, const std::filesystem::path& events);

  [[nodiscard]] semantic::Answer ask(const std::string& question, std::int64_t now_ns) const;
  [[nodiscard]] const semantic::HomeIndex& index() const { return *index_; }
  [[nodiscard]] const semantic::History& history() const { return store_->history(); }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<semantic::HomeStore> store_;
  std::unique_ptr<semantic::HomeIndex> index_;
};

struct TableRow {
  std::string home;
  std::string now;
  std::string question;
  nlohmann::json expect;
};

struct TableScore {
  std::size_t right = 0;
  std::vector<std::string> failures;   ///< question, answer and what was expected
  std::vector<std::string> confident;  ///< of these: answered with something else
};

[[nodiscard]] std::vector<TableRow> readTable(const std::filesystem::path& file);
/// What of the expectation the answer misses; empty: right.
[[nodiscard]] std::string missesOf(const semantic::Answer& answer, const nlohmann::json& expect);
/// `with_events`: the household has lived through demo_events.jsonl; else every home is as its home.xml says.
[[nodiscard]] TableScore score(const std::vector<TableRow>& table, const std::filesystem::path& source_folder, bool with_events = true);

}  // namespace oikos::test
