// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/revert.h"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/nearest_name.h"
#include "tools/command.h"
#include "tools/home_history.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos revert ~/homes/flat-3 monday\n"
    "  oikos revert ~/homes/flat-3 monday --json\n"
    "What was seen since stays. Nothing is deleted: the history says what was taken back. A running daemon sees it at once.\n"
    "Exits with 1 if there is nothing to take back.";

struct RevertOptions {
  std::filesystem::path home;
  std::string recording;
};

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

ExitCode reportNothing(const std::string& recording, std::vector<std::string> known) {
  const auto itself = std::find(known.begin(), known.end(), recording);
  if (itself != known.end()) {
    std::cerr << "oikos: recording '" << recording << "' has been taken back already\n";
  } else {
    std::cerr << "oikos: no recording '" << recording << "' in the history" << base::didYouMean(recording, known) << '\n';
  }
  return ExitCode::kNoAnswer;
}

void print(const semantic::Revert& revert, const std::string& recording, bool json) {
  if (json) {
    const nlohmann::ordered_json answer{
        {"recording", recording}, {"events", revert.events}, {"subjects", revert.subjects}, {"restored", revert.restored}};
    std::cout << answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
    return;
  }
  std::cout << "took back " << counted(static_cast<std::size_t>(revert.events), "event", "events") << " of "
            << counted(revert.subjects.size(), "thing", "things") << "; " << counted(revert.restored.size(), "has", "have")
            << " the state from before again\n";
}

ExitCode revert(const RevertOptions& options, const Session& session) {
  const std::unique_ptr<semantic::History> history = openHistory(options.home);
  const semantic::Revert revert = semantic::revertRecording(*history, options.recording);
  if (revert.events == 0) {
    return reportNothing(options.recording, history->recordings());
  }
  print(revert, options.recording, session.options.json);
  return ExitCode::kDone;
}

}  // namespace

void addRevertCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"revert", "Takes back what one recording has said about a home.", kExamples, false});
  const auto options = std::make_shared<RevertOptions>();
  command.add_option("HOME", options->home, "the home's folder")->required();
  command.add_option("RECORDING", options->recording, "its name in the history")->required();
  setAction(command, [options](const Session& session) { return revert(*options, session); });
}

}  // namespace oikos::tools
