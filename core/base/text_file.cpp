// SPDX-License-Identifier: Apache-2.0
#include "core/base/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/base/error.h"

namespace oikos::base {

std::string readTextFile(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) {
    throw Error(ErrorCode::kIo, "is a folder, a file is needed", file.string());
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw Error(ErrorCode::kIo, std::string("cannot be opened: ") + std::strerror(errno), file.string());
  }
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) {
    throw Error(ErrorCode::kIo, std::string("cannot be read: ") + std::strerror(errno), file.string());
  }
  return text;
}

}  // namespace oikos::base
