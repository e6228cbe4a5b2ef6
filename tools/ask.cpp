// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/base/rfc3339.h"
#include "semantic/history/history.h"
#include "semantic/history/home_state.h"
#include "semantic/history/recollection.h"
#include "semantic/query/answer.h"
#include "tools/command.h"
#include "tools/floor_place.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos ask homes/papers \"where is the blue cup?\"\n"
    "  oikos ask homes/papers \"what is on the table\" --json\n"
    "  oikos ask homes/papers \"is the fridge open\"\n"
    "  oikos ask homes/papers \"which doors are closed\"\n"
    "  oikos ask homes/papers \"how many cups are in the kitchen\"\n"
    "  oikos ask homes/papers \"what is the thermostat set to\"\n"
    "  oikos ask HOME \"where was the blue cup on Monday at 8:00\" --now 2026-03-12T18:00:00Z\n"
    "  oikos ask HOME \"what changed since yesterday\"\n"
    "  oikos ask homes/papers \"bring me the red cup\" --at 0,0,90\n"
    "Exits with 1 if there is no answer.";

struct AskOptions {
  std::filesystem::path home;
  std::string question;
  std::string now;
  std::string at;
};

std::int64_t nowOf(const std::string& text) {
  if (text.empty()) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  }
  const auto now_ns = base::parseRfc3339Ns(text);
  if (!now_ns) {
    throw base::Error(base::ErrorCode::kUsage, "'" + text + "' is no time such as 2026-03-12T18:00:00Z", "--now");
  }
  return *now_ns;
}

std::optional<semantic::RobotPlace> robotOf(const std::string& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  const FloorPlace place = parseFloorPlace(text, "--at");
  return semantic::RobotPlace{place.position_map, place.yaw_rad};
}

ExitCode ask(const AskOptions& options, const Session& session) {
  const std::int64_t now_ns = nowOf(options.now);
  const auto robot = robotOf(options.at);
  const semantic::HomeIndex index(semantic::loadHome(options.home));
  const std::filesystem::path file = options.home / "history.sqlite";
  std::optional<semantic::History> history;
  std::optional<semantic::Recollection> recollection;
  if (std::filesystem::exists(file)) {
    history.emplace(file, semantic::HistoryAccess::kRead);
    recollection.emplace(*history);
  }
  const semantic::Answer answer = semantic::answerQuestion(
      {&index, history ? &*history : nullptr, now_ns, robot, recollection ? &*recollection : nullptr}, options.question);
  if (session.options.json) {
    std::cout << semantic::toJson(answer, 2) << '\n';
  } else {
    for (const std::string& correction : answer.corrected) {
      std::cerr << "oikos: taken for a typing error: " << correction << '\n';
    }
    std::cout << answer.sentence << '\n';
  }
  return answer.status == semantic::AnswerStatus::kAnswered ? ExitCode::kDone : ExitCode::kNoAnswer;
}

}  // namespace

void addAskCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"ask", "Answers one question about a home.", kExamples, false});
  const auto options = std::make_shared<AskOptions>();
  command.add_option("HOME", options->home, "the home's folder")->required();
  command.add_option("QUESTION", options->question, "in English, in quotes")->required();
  command.add_option("--now", options->now, "what the question takes for the present: 2026-03-12T18:00:00Z");
  command.add_option("--at", options->at, "where the robot is: X,Y,YAW (m, degrees); orders parking poses and what is nearest");
  setAction(command, [options](const Session& session) { return ask(*options, session); });
}

}  // namespace oikos::tools
