// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/home_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "core/base/error.h"
#include "core/base/read_file.h"

namespace oikos::semantic {

HomeLock::HomeLock(const std::filesystem::path& home) : file_(base::openFile(home / ".lock", O_RDWR | O_CREAT)) {
  const std::filesystem::path path = home / ".lock";
  if (::flock(file_.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) {
      base::throwErrno("cannot be locked", path);
    }
    throw base::Error(base::ErrorCode::kIo, "in use by " + base::readFile(path) + "; one process at a time keeps a home", home.string());
  }
  std::string name = base::readFile("/proc/self/comm");
  name.erase(name.find_last_not_of('\n') + 1);
  const std::string holder = name + " (process " + std::to_string(::getpid()) + ")";
  // What stands there is for people only: the lock itself is the kernel's.
  if (::ftruncate(file_.number(), 0) != 0 || ::pwrite(file_.number(), holder.data(), holder.size(), 0) < 0) {
    base::throwErrno("cannot be written", path);
  }
}

}  // namespace oikos::semantic
