// SPDX-License-Identifier: Apache-2.0
#include "tools/terminal_progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

namespace oikos::tools {

namespace {

constexpr int kUsualColumns = 80;

int terminalColumns() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col - 1 : kUsualColumns - 1;  // in the last column some terminals break the line
}

}  // namespace

TerminalProgress::TerminalProgress(const GlobalOptions& options) {
  if (!options.quiet && ::isatty(STDERR_FILENO) == 1) {
    bar_.emplace(std::cerr, terminalColumns());
  }
}

base::ProgressSink TerminalProgress::sink() {
  if (!bar_) {
    return {};
  }
  return [this](const base::Progress& progress) { bar_->show(progress); };
}

}  // namespace oikos::tools
