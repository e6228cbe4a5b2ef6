// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tools/command.h"

namespace oikos::tools {

/// The `oikos` program without its commands: global options, and what happens between the command line and the exit code.
class Program {
 public:
  Program();

  /// Commands are added here.
  [[nodiscard]] CLI::App& root() { return *root_; }

  /// Reads the command line, runs the command, reports what went wrong on stderr.
  [[nodiscard]] ExitCode run(int argc, char** argv);

 private:
  ExitCode runCommand(Interrupts& interrupts) const;

  GlobalOptions options_;
  std::unique_ptr<CLI::App> root_;
};

}  // namespace oikos::tools
