// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace oikos::base {

/// Owns a file descriptor.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;

  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

/// Throws Error{kIo}: "WHERE: ACTION: what errno says".
[[noreturn]] void throwErrno(const std::string& action, const std::filesystem::path& where);

/// `flags` as of open(2); O_CLOEXEC is added. Throws Error{kIo}.
[[nodiscard]] FileDescriptor openFile(const std::filesystem::path& file, int flags);

/// Returns when a file's content, or a folder's list of names, is on the disk. Throws Error{kIo}.
void sync(const std::filesystem::path& file_or_folder);

/// Every file and folder below `folder`, and `folder` itself. Throws Error{kIo}.
void syncTree(const std::filesystem::path& folder);

/// The folder that holds `file`; "." for a bare name. A slash at the end does not count.
[[nodiscard]] std::filesystem::path folderOf(const std::filesystem::path& file);

}  // namespace oikos::base
