// SPDX-License-Identifier: Apache-2.0
#include "core/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "core/base/posix_file.h"

namespace oikos::base {

namespace {

/// A file that is removed unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path file) : file_(std::move(file)) {}
  ~TemporaryFile() {
    if (!renamed_) {
      ::unlink(file_.c_str());
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view content) const {
    const FileDescriptor descriptor = openFile(file_, O_WRONLY | O_CREAT | O_TRUNC);
    writeAll(descriptor, content, file_);
    if (::fsync(descriptor.number()) != 0) {
      throwErrno("cannot be brought to the disk", file_);
    }
  }
  void renameTo(const std::filesystem::path& target) {
    if (std::rename(file_.c_str(), target.c_str()) != 0) {
      throwErrno("cannot be replaced", target);
    }
    renamed_ = true;
  }

 private:
  std::filesystem::path file_;
  bool renamed_ = false;
};

}  // namespace

void writeFileAtomically(const std::filesystem::path& file, std::string_view content) {
  const std::filesystem::path folder = folderOf(file);
  // The process number keeps two programs that write the same file apart.
  TemporaryFile temporary(folder / ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".tmp"));
  temporary.write(content);
  temporary.renameTo(file);
  sync(folder);
}

}  // namespace oikos::base
