// SPDX-License-Identifier: Apache-2.0
#include "core/base/replace_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/posix_file.h"
#include "core/base/read_file.h"

namespace oikos::base {

namespace {

/// The new content on the disk, under a hidden name that goes with this object.
class Beside {
 public:
  Beside(const std::filesystem::path& file, std::string_view content) : path_(folderOf(file) / ("." + file.filename().string() + ".new")) {
    writeFileAtomically(path_, content);
  }
  ~Beside() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// False: the file system cannot.
bool exchange(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) {
    return true;
  }
  if (errno != EINVAL && errno != ENOSYS) {
    throwErrno("cannot be replaced", b);
  }
  return false;
}

void replace(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) {
    throwErrno("cannot be replaced", to);
  }
}

/// Where that can be told: nobody gets a lease on a file that somebody has open for writing.
bool isOpenForWriting(const std::filesystem::path& file) {
  const FileDescriptor opened = openFile(file, O_RDONLY);
  ::fcntl(opened.number(), F_SETSIG, SIGURG);  // that does no harm if somebody opens it before the lease is given back
  return ::fcntl(opened.number(), F_SETLEASE, F_RDLCK) != 0 && errno == EAGAIN;
}

/// Exchanges until what comes out is what went in the time before: the file is then as its last writer left it.
void putBack(const std::filesystem::path& came_out, const std::filesystem::path& file, std::string went_in) {
  for (;;) {
    std::string goes_in = readFile(came_out);
    exchange(came_out, file);
    if (readFile(came_out) == went_in) {
      return;
    }
    went_in = std::move(goes_in);
  }
}

}  // namespace

bool replaceFileIfUnchanged(const std::filesystem::path& file, std::string_view expected, std::string_view content) {
  const Beside beside(file, content);
  if (readFile(file) != expected) {
    return false;
  }
  bool unchanged = true;
  if (exchange(beside.path(), file)) {
    unchanged = !isOpenForWriting(beside.path()) && readFile(beside.path()) == expected;
    if (!unchanged) {
      putBack(beside.path(), file, std::string(content));
    }
  } else {
    replace(beside.path(), file);
  }
  sync(folderOf(file));
  return unchanged;
}

}  // namespace oikos::base
