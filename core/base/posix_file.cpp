// SPDX-License-Identifier: Apache-2.0
#include "core/base/posix_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/base/error.h"

namespace oikos::base {

namespace {
constexpr int kPermissions = 0666;  // less the user's umask
}

FileDescriptor::~FileDescriptor() {
  if (number_ >= 0) {
    ::close(number_);
  }
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

void throwErrno(const std::string& action, const std::filesystem::path& where) {
  throw Error(ErrorCode::kIo, action + ": " + std::strerror(errno), where.string());
}

FileDescriptor openFile(const std::filesystem::path& file, int flags) {
  FileDescriptor descriptor(::open(file.c_str(), flags | O_CLOEXEC, kPermissions));
  if (descriptor.number() < 0) {
    throwErrno("cannot open", file);
  }
  return descriptor;
}

void sync(const std::filesystem::path& file_or_folder) {
  const FileDescriptor descriptor = openFile(file_or_folder, O_RDONLY);
  // Some network file systems know no fsync of a folder and say EINVAL.
  if (::fsync(descriptor.number()) != 0 && errno != EINVAL) {
    throwErrno("cannot be brought to the disk", file_or_folder);
  }
}

void syncTree(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() || entry.is_directory()) {
      sync(entry.path());
    }
  }
  sync(folder);
}

std::filesystem::path folderOf(const std::filesystem::path& file) {
  const std::filesystem::path normal = file.lexically_normal();
  const std::filesystem::path folder = (normal.has_filename() ? normal : normal.parent_path()).parent_path();
  return folder.empty() ? "." : folder;
}

}  // namespace oikos::base
