// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace oikos::tools {

class Interrupts;

/// What every command ends with; the numbers are the process's exit code.
enum class ExitCode {
  kDone = 0,
  kNoAnswer = 1,  ///< nothing found, or not converged
  kUsage = 2,     ///< the command line is wrong
  kInput = 3,     ///< a file that was read is wrong
  kIo = 4,        ///< the operating system refused
  kInternal = 5,  ///< a bug
};

/// Options that every command takes, before or after its name.
struct GlobalOptions {
  int threads = 1;               ///< threads to compute with; the default is the number of cores
  std::int64_t seed = 0;         ///< of every random choice
  std::filesystem::path config;  ///< TOML file; empty: none given
  bool json = false;             ///< the answer as JSON on stdout
  bool quiet = false;            ///< no progress
};

/// What `--help` says about a command.
struct CommandText {
  std::string name;
  std::string purpose;        ///< one line
  std::string examples;       ///< whole command lines, one a line
  bool takes_config = false;  ///< without it `--config` is a usage error
};

/// What a command may use while it runs.
struct Session {
  const GlobalOptions& options;
  Interrupts& interrupts;  ///< say here what Ctrl-C has to tidy up
};

/// Runs after the whole command line has been read. Prints its answer on stdout. Throws base::Error.
using Action = std::function<ExitCode(const Session&)>;

/// Adds a command below `parent` (the program itself, or a command that has commands of its own). Add its options to the result.
CLI::App& addCommand(CLI::App& parent, const CommandText& text);

/// Says what a command does. A command without an action needs one of its own commands.
void setAction(CLI::App& command, Action action);

// One file each: tools/NAME.cpp.
void addAskCommand(CLI::App& root);
void addCheckCommand(CLI::App& root);
void addDemoCommand(CLI::App& root);
void addEvaluateCommand(CLI::App& root);
void addForgetCommand(CLI::App& root);
void addInspectCommand(CLI::App& root);
void addLocateCommand(CLI::App& root);
void addMapCommand(CLI::App& root);
void addModelCommand(CLI::App& root);
void addRevertCommand(CLI::App& root);
void addServeCommand(CLI::App& root);
void addSimulateCommand(CLI::App& root);
void addTellCommand(CLI::App& root);
void addTrackCommand(CLI::App& root);

}  // namespace oikos::tools
