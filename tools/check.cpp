// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "semantic/model/file_check.h"
#include "semantic/xml/home_reader.h"
#include "tools/command.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos check ~/homes/flat-3\n"
    "  oikos check homes/papers --json\n"
    "Exits with 3 if there are errors; warnings alone do no harm.";

using semantic::Finding;
using semantic::Severity;

std::string severityName(Severity severity) {
  return severity == Severity::kError ? "error" : "warning";
}

std::string toText(const Finding& finding, const std::filesystem::path& file) {
  std::string text = file.string();
  if (finding.line > 0) {
    text += ":" + std::to_string(finding.line);
  }
  text += ": " + severityName(finding.severity) + ": " + finding.element + ": " + finding.found;
  return finding.expected.empty() ? text : text + "; expected " + finding.expected;
}

std::string toJson(const std::vector<Finding>& findings, const std::filesystem::path& file, std::ptrdiff_t errors) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& f : findings) {
    list.push_back(
        {{"severity", severityName(f.severity)}, {"line", f.line}, {"element", f.element}, {"found", f.found}, {"expected", f.expected}});
  }
  const nlohmann::ordered_json answer{
      {"file", file.string()}, {"errors", errors}, {"warnings", static_cast<std::ptrdiff_t>(findings.size()) - errors}, {"findings", list}};
  return answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Control characters of a hostile file must not reach the terminal.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return text;
}

std::vector<Finding> findingsOf(const std::filesystem::path& home, const std::filesystem::path& file) {
  semantic::HomeReading reading = semantic::readHome(file);
  if (reading.complete) {
    const std::vector<Finding> files = semantic::checkFiles(reading.home, home);
    reading.findings.insert(reading.findings.end(), files.begin(), files.end());
  }
  std::stable_sort(reading.findings.begin(), reading.findings.end(), [](const Finding& a, const Finding& b) { return a.line < b.line; });
  return std::move(reading.findings);
}

ExitCode checkHome(const std::filesystem::path& home, const Session& session) {
  const auto file = home / "home.xml";
  if (!std::filesystem::is_directory(home)) {
    throw base::Error(base::ErrorCode::kIo, "no such folder; a home is a folder with a home.xml", home.string());
  }
  if (!std::filesystem::exists(file)) {
    throw base::Error(base::ErrorCode::kInput, "missing: not a home, or not one yet (docs/formats.md says what stands in it)",
                      file.string());
  }
  const std::vector<Finding> findings = findingsOf(home, file);
  const auto errors = std::count_if(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Severity::kError; });
  if (session.options.json) {
    std::cout << toJson(findings, file, errors) << '\n';
  } else {
    for (const Finding& finding : findings) {
      std::cout << printable(toText(finding, file)) << '\n';
    }
    std::cout << file.string() << ": " << errors << (errors == 1 ? " error, " : " errors, ")
              << findings.size() - static_cast<std::size_t>(errors)
              << (findings.size() - static_cast<std::size_t>(errors) == 1 ? " warning" : " warnings") << '\n';
  }
  return errors > 0 ? ExitCode::kInput : ExitCode::kDone;
}

}  // namespace

void addCheckCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"check", "Validates everything in a home and says what to mend.", kExamples, false});
  const auto home = std::make_shared<std::filesystem::path>();
  command.add_option("HOME", *home, "the home's folder")->required();
  setAction(command, [home](const Session& session) { return checkHome(*home, session); });
}

}  // namespace oikos::tools
