// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/base/progress.h"
#include "tools/command.h"

namespace oikos::tools {

/// A progress bar on stderr if that is a terminal and nobody asked for quiet, else nothing.
class TerminalProgress {
 public:
  explicit TerminalProgress(const GlobalOptions& options);

  /// For a library; valid as long as this object. Empty if there is nobody to look.
  [[nodiscard]] base::ProgressSink sink();

 private:
  std::optional<base::ProgressBar> bar_;
};

}  // namespace oikos::tools
