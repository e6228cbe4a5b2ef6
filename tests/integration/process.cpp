// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "core/base/read_file.h"

extern char** environ;

namespace oikos::test {

namespace {

constexpr int kFileMode = 0600;

[[noreturn]] void throwSystemError(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// No signal blocked or ignored, whatever the test runner does with its own.
void useDefaultSignals(posix_spawnattr_t& attributes) {
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

Process::Process(const std::vector<std::string>& command, const std::filesystem::path& out)
    : out_(out.empty() ? files_.path() / "out" : out), err_(files_.path() / "err") {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out_.c_str(), O_WRONLY | O_CREAT, kFileMode);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err_.c_str(), O_WRONLY | O_CREAT, kFileMode);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  useDefaultSignals(attributes);
  std::vector<std::string> words = command;
  const int failure = posix_spawnp(&pid_, words.front().c_str(), &files, &attributes, pointersTo(words).data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) {
    throw std::system_error(failure, std::generic_category(), command.front());
  }
}

Process::~Process() {
  if (!status_) {
    send(SIGKILL);
    waitForEnd();
  }
}

void Process::send(int signal) const {
  if (!status_) {
    ::kill(pid_, signal);
  }
}

bool Process::hasEndedWithin(std::chrono::microseconds time) {
  if (status_) {
    return true;
  }
  pollfd handle{static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)), POLLIN, 0};
  if (handle.fd < 0) {
    throwSystemError("pidfd_open");
  }
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  const timespec limit{seconds.count(), std::chrono::duration_cast<std::chrono::nanoseconds>(time - seconds).count()};
  const bool ended = ::ppoll(&handle, 1, &limit, nullptr) == 1;
  ::close(handle.fd);
  return ended;
}

void Process::waitForEnd() {
  int status = 0;
  while (!status_) {
    if (::waitpid(pid_, &status, 0) == pid_) {
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    } else if (errno != EINTR) {
      throwSystemError("waitpid");
    }
  }
}

ProcessResult Process::finish() {
  waitForEnd();
  const bool gathered = std::filesystem::is_regular_file(out_);
  return {*status_, gathered ? base::readFile(out_) : "", base::readFile(err_)};
}

std::string oikosBinary() {
  const char* const chosen = std::getenv("OIKOS_BINARY");
  return chosen == nullptr ? OIKOS_BUILT_BINARY : chosen;
}

ProcessResult runOikos(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), oikosBinary());
  return Process(arguments).finish();
}

}  // namespace oikos::test
