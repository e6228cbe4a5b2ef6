// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace oikos::base {

/// A file that appears under its name complete or not at all: it is written under a hidden name beside it, checked after the
/// flush, synced to the disk and renamed by `commit()`. Whoever opens it, and whatever crashes, finds the old content or the
/// new one. Destroyed without a commit, it leaves no trace. Not thread-safe.
class AtomicFile {
 public:
  /// Opens for binary writing. Throws Error{kIo} with the path and the system's reason.
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  [[nodiscard]] std::ostream& stream() { return stream_; }

  /// Throws Error{kIo} if anything written so far did not reach the disk (no space, quota, I/O error); the file is then as
  /// it was before.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
};

/// The same for content that is at hand as a whole.
void writeFileAtomically(const std::filesystem::path& path, std::string_view content);

}  // namespace oikos::base
