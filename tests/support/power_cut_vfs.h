// SPDX-License-Identifier: Apache-2.0
// A disk that loses its power: an SQLite VFS above the default one that keeps what was synced apart from what was only written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace oikos::test {

/// The default VFS of this process while it lives. After `cut_after` operations (open, write, truncate, sync, delete) every further one
/// fails; restore() then leaves in each file only what its last sync had, and no file that was never synced. A file's removal counts at
/// once. A sync of SQLite's shared memory is none: SQLite rebuilds it.
class PowerCutVfs {
 public:
  explicit PowerCutVfs(std::int64_t cut_after);
  ~PowerCutVfs();
  PowerCutVfs(const PowerCutVfs&) = delete;
  PowerCutVfs& operator=(const PowerCutVfs&) = delete;

  [[nodiscard]] bool isCut() const;
  [[nodiscard]] std::int64_t operations() const;
  /// Counts an operation of somebody else on the same disk: whether the power is still there for it.
  [[nodiscard]] bool operate();
  /// Writes what had been synced into the files. All connections must be closed.
  void restore();

  class Disk;

 private:
  std::unique_ptr<Disk> disk_;
};

}  // namespace oikos::test
