// SPDX-License-Identifier: Apache-2.0
#include "core/base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>

#include "core/base/posix_file.h"

namespace oikos::base {

namespace {

constexpr std::size_t kMinChunk = 4096;

/// How much to ask for: the file's size and one byte more, to meet its end; a pipe has no size.
std::size_t firstChunk(const FileDescriptor& descriptor) {
  struct stat status {};
  const bool known = ::fstat(descriptor.number(), &status) == 0 && status.st_size > 0;
  return std::max(known ? static_cast<std::size_t>(status.st_size) + 1 : 0, kMinChunk);
}

}  // namespace

std::string readFile(const std::filesystem::path& file) {
  const FileDescriptor descriptor = openFile(file, O_RDONLY);
  std::string content(firstChunk(descriptor), '\0');
  std::size_t filled = 0;
  while (true) {
    const ssize_t count = ::read(descriptor.number(), content.data() + filled, content.size() - filled);
    if (count == 0) {
      content.resize(filled);
      return content;
    }
    if (count < 0 && errno != EINTR) {
      throwErrno("cannot be read", file);
    }
    filled += count > 0 ? static_cast<std::size_t>(count) : 0;
    if (filled == content.size()) {
      content.resize(2 * content.size());
    }
  }
}

}  // namespace oikos::base
