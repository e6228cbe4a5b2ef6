// SPDX-License-Identifier: Apache-2.0
#include "core/base/staging_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/base/error.h"

namespace oikos::base {

namespace {

constexpr int kFolderPermissions = 0777;  // less the user's umask
constexpr int kAttempts = 100;

/// Whether `path` is still the folder that was opened: its last owner may have removed or renamed it before it was locked.
bool isSameFolder(const FileDescriptor& opened, const std::filesystem::path& path) {
  struct stat by_number {};
  struct stat by_name {};
  return ::fstat(opened.number(), &by_number) == 0 && ::stat(path.c_str(), &by_name) == 0 && by_number.st_ino == by_name.st_ino &&
         by_number.st_dev == by_name.st_dev;
}

/// An open folder that is locked as long as the descriptor lives; the number is -1 if it vanished under our hands.
FileDescriptor tryMakeLocked(const std::filesystem::path& folder) {
  if (::mkdir(folder.c_str(), kFolderPermissions) != 0 && errno != EEXIST) {
    throwErrno("cannot be made", folder);
  }
  FileDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.number() < 0) {
    if (errno == ENOENT) {
      return opened;
    }
    throwErrno("cannot be opened", folder);
  }
  if (::flock(opened.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) {
      throw Error(ErrorCode::kIo, "another process is writing here; wait until it has finished", folderOf(folder).string());
    }
    throwErrno("cannot be locked", folder);
  }
  if (!isSameFolder(opened, folder)) {
    return FileDescriptor(-1);
  }
  return opened;
}

FileDescriptor makeLocked(const std::filesystem::path& folder) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    FileDescriptor locked = tryMakeLocked(folder);
    if (locked.number() >= 0) {
      return locked;
    }
  }
  throw Error(ErrorCode::kIo, "is made and removed by other processes all the time", folder.string());
}

/// What discard() calls the folder until it is gone.
std::filesystem::path discardedPath(std::filesystem::path folder) {
  return folder += ".discarded";
}

void removeContent(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::error_code failure;
    std::filesystem::remove_all(entry.path(), failure);
    if (failure) {
      throw Error(ErrorCode::kIo, "left by a run that was killed, cannot be removed: " + failure.message(), entry.path().string());
    }
  }
}

void renameWithFlags(const std::filesystem::path& from, const std::filesystem::path& to, unsigned flags) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0) {
    return;
  }
  if (errno == EINVAL || errno == ENOSYS) {
    throw Error(ErrorCode::kIo, "this file system cannot exchange folders in one step; choose a place on ext4, xfs, btrfs or tmpfs",
                to.string());
  }
  if (errno == EEXIST) {
    throw Error(ErrorCode::kIo, "was made by another process meanwhile; nothing was changed in it", to.string());
  }
  throwErrno("cannot be put in place", to);
}

void syncBothFolders(const std::filesystem::path& staged, const std::filesystem::path& target) {
  sync(folderOf(target));
  sync(folderOf(staged));
}

}  // namespace

StagingFolder::StagingFolder(const std::filesystem::path& folder) : path_(folder), lock_(makeLocked(folder)) {
  removeContent(path_);
  std::error_code another_process_may_remove_it_too;
  std::filesystem::remove_all(discardedPath(path_), another_process_may_remove_it_too);
}

StagingFolder::~StagingFolder() {
  discard();
}

void StagingFolder::discard() noexcept {
  const std::lock_guard lock(mutex_);
  if (discarded_ || !isSameFolder(lock_, path_)) {
    return;  // published as a whole: it has another name now
  }
  discarded_ = true;
  // Under another name no thread finds it any more; one that has a path resolved already may still add a file, hence the rounds.
  const std::filesystem::path discarded = discardedPath(path_);
  std::error_code failure;
  std::filesystem::rename(path_, discarded, failure);
  const std::filesystem::path& doomed = failure ? path_ : discarded;
  for (int attempt = 0; attempt < kAttempts && std::filesystem::exists(doomed, failure); ++attempt) {
    std::filesystem::remove_all(doomed, failure);
  }
}

void publishFolder(const std::filesystem::path& staged, const std::filesystem::path& target) {
  renameWithFlags(staged, target, std::filesystem::exists(target) ? RENAME_EXCHANGE : RENAME_NOREPLACE);
  syncBothFolders(staged, target);
}

void publishNewFolder(const std::filesystem::path& staged, const std::filesystem::path& target) {
  renameWithFlags(staged, target, RENAME_NOREPLACE);
  syncBothFolders(staged, target);
}

void publishFile(const std::filesystem::path& staged, const std::filesystem::path& target) {
  renameWithFlags(staged, target, 0);
  syncBothFolders(staged, target);
}

}  // namespace oikos::base
