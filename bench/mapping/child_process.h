// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace oikos::bench {

/// A command that has ended, and what it took.
struct ChildRun {
  int exit_code = -1;  ///< negative: the signal that ended it
  double wall_s = 0.0;
  double cpu_s = 0.0;    ///< user and system, all threads
  double peak_mb = 0.0;  ///< greatest resident memory, 10^6 bytes; never less than what this process itself had held at the start
  std::string out;       ///< its standard output
};

/// Runs a command to its end; its standard output goes by way of `out_file`, its standard error is ours. Throws std::system_error
/// if it cannot be started.
[[nodiscard]] ChildRun runChild(std::vector<std::string> command, const std::filesystem::path& out_file);

/// Greatest resident memory of this process so far, 10^6 bytes.
[[nodiscard]] double ownPeakMb();

}  // namespace oikos::bench
