// SPDX-License-Identifier: Apache-2.0
// The files of a folder on a disk that loses its power; those of SQLite are PowerCutVfs's.
#pragma once

#include <sys/types.h>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/base/posix_file.h"
#include "tests/support/file_calls.h"

namespace oikos::test {

/// Of the files whose names have `part` in them: keeps apart what was synced, of contents and of names, from what was only written. Each
/// sync and renaming is an operation; once `operate` says that the power is gone, it fails. Not thread-safe.
class PowerCutFolder : public FileCalls {
 public:
  PowerCutFolder(std::filesystem::path folder, std::string part, std::function<bool()> operate);

  std::optional<int> rename(const std::filesystem::path& to) override;
  std::optional<int> sync(const std::filesystem::path& file_or_folder) override;

  /// Leaves what survives: contents as they were synced, nothing in files that never were. Names of the last sync of the folder; or, since
  /// a disk may be quicker than it has to be, those of the moment of the cut.
  void restore(bool later_names);

 private:
  using Names = std::map<std::filesystem::path, ino_t>;

  [[nodiscard]] Names namesNow() const;
  void keepContent(const std::filesystem::path& file);

  struct Content {
    base::FileDescriptor opened;  ///< so that its number is not given to another file
    std::string text;
  };
  const std::filesystem::path folder_;
  const std::string part_;
  const std::function<bool()> operate_;
  std::map<ino_t, Content> synced_;
  Names durable_;
};

}  // namespace oikos::test
