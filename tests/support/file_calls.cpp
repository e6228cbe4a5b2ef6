// SPDX-License-Identifier: Apache-2.0
#include "tests/support/file_calls.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace oikos::test {

namespace {

std::atomic<FileCalls*> active = nullptr;

/// The result of a call that somebody else answers.
std::optional<int> resultOf(const std::optional<int>& answer) {
  if (!answer) {
    return std::nullopt;
  }
  errno = *answer;
  return *answer == 0 ? 0 : -1;
}

std::optional<int> askAboutRename(const char* to) {
  FileCalls* const calls = active;
  return calls == nullptr ? std::nullopt : resultOf(calls->rename(to));
}

std::optional<int> askAboutSync(int descriptor) {
  FileCalls* const calls = active;
  if (calls == nullptr) {
    return std::nullopt;
  }
  std::error_code none;
  return resultOf(calls->sync(std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), none)));
}

}  // namespace

FileCalls::FileCalls() : earlier_(active.exchange(this)) {}

FileCalls::~FileCalls() {
  active = earlier_;
}

RenameHook::RenameHook(std::filesystem::path to, std::function<int()> before) : to_(std::move(to)), before_(std::move(before)) {}

std::optional<int> RenameHook::rename(const std::filesystem::path& to) {
  if (called_ || to != to_) {
    return std::nullopt;
  }
  called_ = true;
  const int failure = before_();
  called_ = false;
  return failure == 0 ? std::nullopt : std::optional(failure);
}

}  // namespace oikos::test

extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  if (const auto answer = oikos::test::askAboutRename(to)) {
    return *answer;
  }
  return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

extern "C" int rename(const char* from, const char* to) noexcept {
  if (const auto answer = oikos::test::askAboutRename(to)) {
    return *answer;
  }
  return static_cast<int>(::syscall(SYS_rename, from, to));
}

extern "C" int fsync(int descriptor) {
  if (const auto answer = oikos::test::askAboutSync(descriptor)) {
    return *answer;
  }
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}
