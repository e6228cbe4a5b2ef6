// SPDX-License-Identifier: Apache-2.0
// What happens at the very moment in which a file is renamed. A test that links this has rename(2) and renameat2(2) of its own in front of the
// system's.
#pragma once

#include <filesystem>
#include <functional>

namespace oikos::test {

/// While it lives, `before` is called ahead of each renaming to `to`; with other than 0 it fails with that errno. One at a time.
class RenameHook {
 public:
  RenameHook(std::filesystem::path to, std::function<int()> before);
  ~RenameHook();
  RenameHook(const RenameHook&) = delete;
  RenameHook& operator=(const RenameHook&) = delete;

 private:
  std::filesystem::path to_;
  std::function<int()> before_;

  friend int renameWithHook(const char* to);
};

}  // namespace oikos::test
