// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "semantic/history/event_json.h"
#include "semantic/history/history.h"
#include "semantic/history/home_state.h"
#include "semantic/query/statement.h"
#include "tools/command.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos tell HOME \"the blue cup is in the bathroom\"\n"
    "  oikos tell HOME \"I put the keys on the desk\"\n"
    "  oikos tell HOME \"the oven is off\"\n"
    "It counts until something newer is seen. Exits with 1 if it was not understood.";

struct TellOptions {
  std::filesystem::path home;
  std::string statement;
};

ExitCode tell(const TellOptions& options, const Session& session) {
  const semantic::HomeState state(semantic::loadHome(options.home));
  const semantic::StatementReading reading = semantic::readStatement(semantic::HomeIndex(state.home()), options.statement);
  nlohmann::ordered_json json{{"sentence", reading.sentence}, {"event", nullptr}};
  if (reading.correction) {
    semantic::Event event;
    event.time_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
    event.subject = reading.correction->subject;
    event.kind = semantic::EventKind::kCorrected;
    event.before = state.findState(event.subject);
    event.after = reading.correction->after;
    state.check(event);
    event.number = semantic::History(options.home / "history.sqlite", semantic::HistoryAccess::kAppend).append({&event, 1});
    json["event"] = semantic::toJson(event);
  }
  std::cout << (session.options.json ? json.dump(2) : reading.sentence) << '\n';
  return reading.correction ? ExitCode::kDone : ExitCode::kNoAnswer;
}

}  // namespace

void addTellCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"tell", "Notes what a person says about a home.", kExamples, false});
  const auto options = std::make_shared<TellOptions>();
  command.add_option("HOME", options->home, "the home's folder")->required();
  command.add_option("STATEMENT", options->statement, "in English, in quotes")->required();
  setAction(command, [options](const Session& session) { return tell(*options, session); });
}

}  // namespace oikos::tools
