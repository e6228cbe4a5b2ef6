// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/evidence_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace oikos::semantic {

namespace {

/// errno of a path that does not lead to a file, rather than of a system in trouble.
bool leadsNowhere(int error) {
  return error == ELOOP || error == ENOTDIR || error == ENAMETOOLONG;
}

}  // namespace

bool isEvidencePath(const std::string& path) {
  const std::filesystem::path parts(path);
  const auto isStray = [](const std::filesystem::path& part) { return part.empty() || part == "." || part == ".."; };
  return parts.is_relative() && path.find('\0') == std::string::npos && std::distance(parts.begin(), parts.end()) >= 2 &&
         *parts.begin() == "evidence" && std::none_of(parts.begin(), parts.end(), isStray);
}

EvidenceFolder::EvidenceFolder(std::filesystem::path home) : home_(std::move(home)) {}

std::optional<base::FileDescriptor> EvidenceFolder::openParent(const std::filesystem::path& path) const {
  base::FileDescriptor folder = base::openFile(home_, O_RDONLY | O_DIRECTORY);
  for (const std::filesystem::path& name : path.parent_path()) {
    const int next = ::openat(folder.number(), name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (next < 0) {
      return std::nullopt;
    }
    folder = base::FileDescriptor(next);
  }
  return folder;
}

EvidenceFolder::Image EvidenceFolder::look(const std::string& path) const {
  if (!isEvidencePath(path)) {
    return Image::kOther;
  }
  const std::optional<base::FileDescriptor> folder = openParent(path);
  return folder ? lookIn(*folder, path) : imageOfErrno(path);
}

EvidenceFolder::Image EvidenceFolder::lookIn(const base::FileDescriptor& folder, const std::filesystem::path& path) const {
  struct stat status {};
  if (::fstatat(folder.number(), path.filename().c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
    return imageOfErrno(path);
  }
  return S_ISREG(status.st_mode) ? Image::kFile : Image::kOther;
}

EvidenceFolder::Image EvidenceFolder::imageOfErrno(const std::filesystem::path& path) const {
  if (errno == ENOENT) {
    return Image::kMissing;
  }
  if (leadsNowhere(errno)) {
    return Image::kOther;
  }
  base::throwErrno("cannot be reached", home_ / path);
}

EvidenceFolder::Image EvidenceFolder::remove(const std::string& path) const {
  if (!isEvidencePath(path)) {
    return Image::kOther;
  }
  const std::optional<base::FileDescriptor> folder = openParent(path);
  if (!folder) {
    return imageOfErrno(path);
  }
  const Image image = lookIn(*folder, path);
  if (image != Image::kFile) {
    return image;
  }
  if (::unlinkat(folder->number(), std::filesystem::path(path).filename().c_str(), 0) != 0) {
    base::throwErrno("cannot be removed", home_ / path);
  }
  if (::fsync(folder->number()) != 0 && errno != EINVAL) {  // some network file systems know no fsync of a folder
    base::throwErrno("cannot be brought to the disk", home_ / path);
  }
  return image;
}

}  // namespace oikos::semantic
