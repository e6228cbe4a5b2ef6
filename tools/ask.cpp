// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "core/base/error.h"
#include "semantic/query/answer.h"
#include "semantic/xml/home_reader.h"
#include "tools/command.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos ask homes/papers \"where is the blue cup?\"\n"
    "  oikos ask homes/papers \"what is on the table\" --json\n"
    "  oikos ask homes/papers \"is the fridge open\"\n"
    "  oikos ask homes/papers \"which doors are closed\"\n"
    "  oikos ask homes/papers \"how many cups are in the kitchen\"\n"
    "  oikos ask homes/papers \"what is the thermostat set to\"\n"
    "Exits with 1 if there is no answer.";

struct AskOptions {
  std::filesystem::path home;
  std::string question;
};

semantic::Home loadHome(const std::filesystem::path& folder) {
  semantic::HomeReading reading = semantic::readHome(folder / "home.xml");
  for (const semantic::Finding& finding : reading.findings) {
    if (finding.severity == semantic::Severity::kError) {
      throw base::Error(base::ErrorCode::kInput,
                        finding.element + ": " + finding.found + " (oikos check " + folder.string() + " lists everything)",
                        (folder / "home.xml").string() + ":" + std::to_string(finding.line));
    }
  }
  return std::move(reading.home);
}

ExitCode ask(const AskOptions& options, const Session& session) {
  const semantic::Home home = loadHome(options.home);
  const semantic::Answer answer = semantic::answerQuestion(semantic::HomeIndex(home), options.question);
  if (session.options.json) {
    std::cout << semantic::toJson(answer) << '\n';
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
  setAction(command, [options](const Session& session) { return ask(*options, session); });
}

}  // namespace oikos::tools
