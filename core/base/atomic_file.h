// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>

namespace oikos::base {

/// A file that appears under its name complete or not at all: it is written beside its name, checked after the flush, synced to
/// the disk and renamed by `commit()`. Destroyed without a commit, it leaves no trace. Not thread-safe.
class AtomicFile {
 public:
  /// Opens for binary writing. Throws Error{kIo} with the path and the system's reason.
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  [[nodiscard]] std::ostream& stream() { return stream_; }

  /// Throws Error{kIo} if anything written so far did not reach the disk (no space, quota, I/O error).
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
};

}  // namespace oikos::base
