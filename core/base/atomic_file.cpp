// SPDX-License-Identifier: Apache-2.0
#include "core/base/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/error.h"
#include "core/base/posix_file.h"

namespace oikos::base {

namespace {

/// The process number keeps two programs that write the same file apart.
std::filesystem::path temporaryName(const std::filesystem::path& path) {
  return folderOf(path) / ("." + path.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), temporary_(temporaryName(path_)) {
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) {
    throwErrno("cannot be created", path_);
  }
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) {
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
}

void AtomicFile::commit() {
  OIKOS_CHECK(!temporary_.empty());
  stream_.flush();
  const bool written = stream_.good();
  stream_.close();
  if (!written || stream_.fail()) {
    // A stream forgets errno, and something else may have set it since: no reason is better than a wrong one.
    throw Error(ErrorCode::kIo, "cannot be written: the disk is full or failed", path_.string());
  }
  sync(temporary_);
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    throwErrno("cannot be replaced", path_);
  }
  temporary_.clear();
  sync(folderOf(path_));
}

void writeFileAtomically(const std::filesystem::path& path, std::string_view content) {
  AtomicFile file(path);
  file.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  file.commit();
}

}  // namespace oikos::base
