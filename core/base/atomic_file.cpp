// SPDX-License-Identifier: Apache-2.0
#include "core/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/error.h"

namespace oikos::base {

namespace {

[[noreturn]] void throwIo(const std::string& what, const std::filesystem::path& path) {
  const int reason = errno;
  throw Error(ErrorCode::kIo, reason != 0 ? what + " (" + std::strerror(reason) + ")" : what, path.string());
}

/// std::ofstream has no fsync: the data is synced through a descriptor of its own.
void syncToDisk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    throwIo("cannot be opened for syncing", path);
  }
  const int failed = ::fsync(descriptor);
  const int reason = errno;
  ::close(descriptor);
  if (failed != 0) {
    errno = reason;
    throwIo("cannot be written to the disk", path);
  }
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), temporary_(path_) {
  temporary_ += ".part";
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) {
    throwIo("cannot be created", path_);
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
  errno = 0;
  stream_.flush();
  const bool written = stream_.good();
  stream_.close();
  if (!written || stream_.fail()) {
    throwIo("cannot be written", path_);
  }
  syncToDisk(temporary_);
  errno = 0;
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
    throwIo("cannot be renamed into place", path_);
  }
  temporary_.clear();
}

}  // namespace oikos::base
