// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/posix_file.h"

namespace oikos::semantic {

/// Whether a path below a home says `evidence/…/NAME` with nothing in it that leads elsewhere (absolute, `..`, `.`).
[[nodiscard]] bool isEvidencePath(const std::string& path);

/// HOME/evidence. A path through it never follows a symbolic link, also when one appears meanwhile. Not thread-safe.
class EvidenceFolder {
 public:
  explicit EvidenceFolder(std::filesystem::path home);

  enum class Image { kFile, kMissing, kOther };
  /// What is there, by its path below the home; kOther: no file, or not below HOME/evidence. Throws Error{kIo}.
  [[nodiscard]] Image look(const std::string& path) const;
  /// Removes it if it is a file, and returns what was there; it is gone from the disk then. Throws Error{kIo}.
  Image remove(const std::string& path) const;

 private:
  /// The folder that holds `path`; nothing with errno set: it cannot be reached.
  [[nodiscard]] std::optional<base::FileDescriptor> openParent(const std::filesystem::path& path) const;
  [[nodiscard]] Image lookIn(const base::FileDescriptor& folder, const std::filesystem::path& path) const;
  [[nodiscard]] Image imageOfErrno(const std::filesystem::path& path) const;

  std::filesystem::path home_;
};

}  // namespace oikos::semantic
