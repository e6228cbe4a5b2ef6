// SPDX-License-Identifier: Apache-2.0
#include "bench/mapping/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>

#include "core/base/read_file.h"

extern char** environ;

namespace oikos::bench {

namespace {

constexpr int kFileMode = 0600;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

/// ru_maxrss is in kibibytes.
double megabytes(const rusage& usage) {
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
}

pid_t start(std::vector<std::string>& command, const std::filesystem::path& out_file) {
  std::vector<char*> words;
  for (std::string& word : command) {
    words.push_back(word.data());
  }
  words.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kFileMode);
  pid_t child = -1;
  const int failure = posix_spawnp(&child, words.front(), &files, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) {
    throw std::system_error(failure, std::generic_category(), command.front());
  }
  return child;
}

}  // namespace

ChildRun runChild(std::vector<std::string> command, const std::filesystem::path& out_file) {
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = start(command, out_file);
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) != child) {
    if (errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "wait4");
    }
  }
  ChildRun run;
  run.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  run.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  run.peak_mb = megabytes(usage);
  run.out = base::readFile(out_file);
  return run;
}

double ownPeakMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return megabytes(usage);
}

}  // namespace oikos::bench
