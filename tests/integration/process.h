// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace oikos::test {

/// How a process ended and what it wrote.
struct ProcessResult {
  int exit_code = -1;  ///< negative: the signal that ended it
  std::string out;
  std::string err;
};

/// A running child process, its signals as a shell's child has them, its stdin empty. Killed if it still runs at the end.
class Process {
 public:
  /// `out` replaces the file that stdout is gathered in.
  explicit Process(const std::vector<std::string>& command, const std::filesystem::path& out = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal) const;
  /// Waits for its end, but not longer than this; whether it has ended.
  bool hasEndedWithin(std::chrono::microseconds time);
  /// Waits for its end.
  ProcessResult finish();

 private:
  void waitForEnd();

  TemporaryFolder files_;
  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// The program under test: $OIKOS_BINARY, else the one that was built with the tests.
[[nodiscard]] std::string oikosBinary();

/// `oikos ARGUMENTS`, to its end.
[[nodiscard]] ProcessResult runOikos(std::vector<std::string> arguments);

}  // namespace oikos::test
