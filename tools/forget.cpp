// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/forget.h"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/base/rfc3339.h"
#include "tools/command.h"
#include "tools/home_history.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos forget ~/homes/flat-3 --recording monday\n"
    "  oikos forget ~/homes/flat-3 --object pills-box\n"
    "  oikos forget ~/homes/flat-3 --before 2026-01-01T00:00:00+01:00\n"
    "  oikos forget ~/homes/flat-3 --all --json\n"
    "Images of events that were taken back go too. What was seen stays in the history, and so does that its image was removed.\n"
    "Exits with 1 for a recording or an object that the history does not know.";

struct ForgetOptions {
  std::filesystem::path home;
  std::string recording;
  std::string object;
  std::string before;
  bool all = false;
};

std::int64_t clock_ns() {
  using std::chrono::nanoseconds;
  return std::chrono::duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

semantic::ForgetSelection selectionOf(const ForgetOptions& options) {
  semantic::ForgetSelection selection;
  if (!options.recording.empty()) {
    selection.recording = options.recording;
  }
  if (!options.object.empty()) {
    selection.subject = options.object;
  }
  if (!options.before.empty()) {
    selection.before_ns = base::parseRfc3339Ns(options.before);
    if (!selection.before_ns) {
      throw base::Error(base::ErrorCode::kUsage,
                        "--before " + options.before + ": expected a time with its offset, for instance 2026-03-02T08:00:00Z");
    }
  }
  return selection;
}

bool isKnown(const std::string& what, const std::string& name, const std::vector<std::string>& known) {
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) {
    return true;
  }
  std::cerr << "oikos: no " << what << " '" << name << "' in the history" << base::didYouMean(name, known) << '\n';
  return false;
}

void print(const semantic::Forgetting& forgetting, bool json) {
  for (const std::string& path : forgetting.untouched) {
    std::cerr << "oikos: left alone, no file below the home's evidence folder: " << nlohmann::json(path).dump(-1, ' ', true) << '\n';
  }
  if (json) {
    const nlohmann::ordered_json answer{
        {"removed", forgetting.removed}, {"missing", forgetting.missing}, {"untouched", forgetting.untouched}};
    std::cout << answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
    return;
  }
  std::cout << "removed " << forgetting.removed.size() << (forgetting.removed.size() == 1 ? " image" : " images");
  if (!forgetting.missing.empty()) {
    std::cout << "; " << forgetting.missing.size() << (forgetting.missing.size() == 1 ? " was" : " were") << " gone already";
  }
  std::cout << '\n';
}

ExitCode forget(const ForgetOptions& options, const Session& session) {
  const semantic::ForgetSelection selection = selectionOf(options);
  const std::unique_ptr<semantic::History> history = openHistory(options.home);
  if (!isKnown("recording", options.recording, history->recordings()) || !isKnown("object", options.object, history->subjects())) {
    return ExitCode::kNoAnswer;
  }
  print(semantic::forgetEvidence(*history, options.home, selection, clock_ns()), session.options.json);
  return ExitCode::kDone;
}

}  // namespace

void addForgetCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"forget", "Removes evidence images from a home.", kExamples, false});
  const auto options = std::make_shared<ForgetOptions>();
  command.add_option("HOME", options->home, "the home's folder")->required();
  CLI::Option_group& whose = *command.add_option_group("whose", "exactly one of these");
  whose.add_option("--recording", options->recording, "images of this recording");
  whose.add_option("--object", options->object, "images of this object, by its id");
  whose.add_option("--before", options->before, "images of what happened before this time (RFC 3339)");
  whose.add_flag("--all", options->all, "every image");
  whose.require_option(1);
  setAction(command, [options](const Session& session) { return forget(*options, session); });
}

}  // namespace oikos::tools
