// SPDX-License-Identifier: Apache-2.0
// What happens at the very moment in which a file is renamed or synced. A test that links this has rename(2), renameat2(2) and fsync(2) of
// its own in front of the system's.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

namespace oikos::test {

/// While it lives, it is asked ahead of each call of this process; the last one made, if there are several. Nothing: the call goes its way;
/// a number: it does not, and fails with that errno, or seems to succeed with 0.
class FileCalls {
 public:
  FileCalls();
  virtual ~FileCalls();
  FileCalls(const FileCalls&) = delete;
  FileCalls& operator=(const FileCalls&) = delete;

  virtual std::optional<int> rename(const std::filesystem::path& /*to*/) { return std::nullopt; }
  virtual std::optional<int> sync(const std::filesystem::path& /*file_or_folder*/) { return std::nullopt; }

 private:
  FileCalls* const earlier_;
};

/// Calls `before` ahead of each renaming to `to`; with other than 0 it fails with that errno.
class RenameHook : public FileCalls {
 public:
  RenameHook(std::filesystem::path to, std::function<int()> before);
  std::optional<int> rename(const std::filesystem::path& to) override;

 private:
  std::filesystem::path to_;
  std::function<int()> before_;
  bool called_ = false;  // what it calls may rename something itself
};

}  // namespace oikos::test
