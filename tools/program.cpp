// SPDX-License-Identifier: Apache-2.0
#include "tools/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <new>
#include <opencv2/core.hpp>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "tools/interrupts.h"
#include "version.h"

namespace oikos::tools {

namespace {

constexpr int kMaxThreads = 256;

/// A command's App with what it does.
class CommandApp : public CLI::App {
 public:
  using CLI::App::App;
  Action action;
  bool takes_config = false;
};

ExitCode report(ExitCode code, const std::string& what) {
  std::cerr << "oikos: " << what << '\n';
  return code;
}

/// The innermost command that was named; the root if none was.
const CLI::App& chosenCommand(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : chosenCommand(*chosen.front());
}

/// `oikos evaluate`, as the user would type it.
std::string commandLineOf(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : commandLineOf(*app.get_parent()) + " " + app.get_name();
}

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    names.push_back(command->get_name());
  }
  return names;
}

/// The first word that was not understood, if it stands where a command has to stand; else empty.
std::string misspeltCommand(const CLI::App& root, const CLI::App& chosen) {
  const auto unread = root.remaining(true);
  return commandNames(chosen).empty() || unread.empty() || unread.front().starts_with('-') ? "" : unread.front();
}

ExitCode reportUsage(const CLI::App& root, const CLI::ParseError& error) {
  const CLI::App& command = chosenCommand(root);
  const std::string line = commandLineOf(command);
  std::string what = error.what();
  if (const std::string word = misspeltCommand(root, command); !word.empty()) {
    what = "no command '" + word + "'" + base::didYouMean(word, commandNames(command));
  }
  return report(ExitCode::kUsage, what + " (see " + line + " --help)");
}

ExitCode parse(CLI::App& root, int argc, char** argv, bool& finished) {
  finished = true;
  try {
    root.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    root.exit(help_or_version, std::cout, std::cerr);
    return ExitCode::kDone;
  } catch (const CLI::ParseError& error) {
    return reportUsage(root, error);
  }
  finished = false;
  return ExitCode::kDone;
}

ExitCode flushAnswer(ExitCode code) {
  std::cout.flush();
  return std::cout.good() || code != ExitCode::kDone ? code : report(ExitCode::kIo, "stdout: the answer could not be written");
}

}  // namespace

CLI::App& addCommand(CLI::App& parent, const CommandText& text) {
  const auto command = std::make_shared<CommandApp>(text.purpose, text.name);
  parent.add_subcommand(command);
  parent.require_subcommand(0, 1);
  command->takes_config = text.takes_config;
  command->fallthrough();
  command->footer("Examples:\n" + text.examples + "\nOptions of every command: oikos --help");
  return *command;
}

void setAction(CLI::App& command, Action action) {
  auto* const app = dynamic_cast<CommandApp*>(&command);
  OIKOS_CHECK(app != nullptr);
  app->action = std::move(action);
}

Program::Program() : root_(std::make_unique<CLI::App>("Gives a domestic robot a memory of the home.", "oikos")) {
  options_.threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxThreads);
  CLI::App& root = *root_;
  root.set_version_flag("--version", std::string("oikos ") + kVersion, "print the version and exit");
  root.set_help_flag("-h,--help", "print this help and exit");
  root.add_option("--threads", options_.threads, "threads to compute with; the result does not depend on it")
      ->check(CLI::Range(1, kMaxThreads))
      ->capture_default_str();
  root.add_option("--seed", options_.seed, "seed of every random choice")->capture_default_str();
  root.add_option("--config", options_.config, "TOML file with parameters that differ from their defaults");
  root.add_flag("--json", options_.json, "print the answer as JSON on stdout");
  root.add_flag("--quiet", options_.quiet, "show no progress");
  root.footer(
      "Examples:\n"
      "  oikos inspect ~/drives/flat-3\n"
      "  oikos map ~/drives/flat-3 --out ~/homes/flat-3\n"
      "  oikos map --help\n"
      "Exit codes: 0 done, 1 no answer, 2 wrong usage, 3 wrong input, 4 I/O, 5 internal error.");
}

ExitCode Program::run(int argc, char** argv) {
  // A write beyond the file size limit has to come back as an error, not as the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
  Interrupts interrupts;
  cv::setNumThreads(1);  // parallelism is ours: OpenCV's would change sums with the number of threads
  cv::setRNGSeed(0);
  bool finished = false;
  const ExitCode code = parse(*root_, argc, argv, finished);
  return finished ? flushAnswer(code) : runCommand(interrupts);
}

ExitCode Program::runCommand(Interrupts& interrupts) const {
  const CLI::App& chosen = chosenCommand(*root_);
  const auto* const command = dynamic_cast<const CommandApp*>(&chosen);
  if (command == nullptr || !command->action) {
    return report(ExitCode::kUsage, "a command is missing (see " + commandLineOf(chosen) + " --help)");
  }
  if (!options_.config.empty() && !command->takes_config) {
    return report(ExitCode::kUsage, "--config: " + commandLineOf(chosen) + " has no parameters that a file could give");
  }
  try {
    return flushAnswer(command->action({options_, interrupts}));
  } catch (const base::Error& error) {
    interrupts.stop();
    return report(static_cast<ExitCode>(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    interrupts.stop();
    return report(ExitCode::kIo, "the operating system gave no more memory; close other programs, or use a coarser resolution");
  } catch (const std::exception& error) {
    interrupts.stop();
    return report(ExitCode::kInternal, std::string("internal error, please report it: ") + error.what());
  } catch (...) {
    interrupts.stop();
    return report(ExitCode::kInternal, "internal error, please report it");
  }
}

}  // namespace oikos::tools
