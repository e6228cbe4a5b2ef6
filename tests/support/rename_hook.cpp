// SPDX-License-Identifier: Apache-2.0
#include "tests/support/rename_hook.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <utility>

namespace oikos::test {

namespace {

RenameHook* active = nullptr;

}  // namespace

RenameHook::RenameHook(std::filesystem::path to, std::function<int()> before) : to_(std::move(to)), before_(std::move(before)) {
  active = this;
}

RenameHook::~RenameHook() {
  active = nullptr;
}

/// An errno, or 0.
int renameWithHook(const char* to) {
  RenameHook* const hook = active;
  if (hook == nullptr || hook->to_ != to) {
    return 0;
  }
  active = nullptr;  // it may rename something itself
  const int failure = hook->before_();
  active = hook;
  return failure;
}

}  // namespace oikos::test

extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  if (const int failure = oikos::test::renameWithHook(to)) {
    errno = failure;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

extern "C" int rename(const char* from, const char* to) noexcept {
  if (const int failure = oikos::test::renameWithHook(to)) {
    errno = failure;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_rename, from, to));
}
