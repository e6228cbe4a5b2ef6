// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/base/posix_file.h"

namespace oikos::semantic {

/// Held by the one process that may write a home's home.xml: HOME/.lock, which says who it is. Gone with the process, however it ends.
class HomeLock {
 public:
  /// Throws Error{kIo} that names the holder if another has it.
  explicit HomeLock(const std::filesystem::path& home);

 private:
  base::FileDescriptor file_;
};

}  // namespace oikos::semantic
