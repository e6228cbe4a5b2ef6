// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <mutex>

#include "core/base/posix_file.h"

namespace oikos::base {

/// A folder to prepare files in, on the same file system as the place they go to, for one writer at a time. What a killed
/// process left in it is removed. It is removed at the end, with what was not published out of it.
class StagingFolder {
 public:
  /// Makes `folder` (fixed name, hidden by a leading dot) and locks it. Throws Error{kIo}: another process holds it, or the
  /// operating system refuses.
  explicit StagingFolder(const std::filesystem::path& folder);
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Removes the folder, even while other threads still write into it (their writes then fail). Thread-safe.
  void discard() noexcept;

 private:
  std::filesystem::path path_;
  FileDescriptor lock_;
  std::mutex mutex_;
  bool discarded_ = false;
};

/// Moves `staged` to `target` in one step that a crash cannot divide. If `target` exists, the two change places: `staged` is
/// then the old one. The content must be on the disk already (`syncTree`). Throws Error{kIo}; `target` is then as it was.
void publishFolder(const std::filesystem::path& staged, const std::filesystem::path& target);

/// As publishFolder for a place where nothing is: something that another process has put there is an error and stays.
void publishNewFolder(const std::filesystem::path& staged, const std::filesystem::path& target);

/// As publishFolder for a file; an existing `target` is replaced.
void publishFile(const std::filesystem::path& staged, const std::filesystem::path& target);

}  // namespace oikos::base
