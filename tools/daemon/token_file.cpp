// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/token_file.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "core/base/error.h"
#include "core/base/posix_file.h"

namespace oikos::daemon {

namespace {

constexpr std::size_t kRandomBytes = 32;
constexpr std::size_t kShortest = 16;
constexpr mode_t kOwnerOnly = 0600;

std::string randomToken() {
  constexpr const char* kDigits = "0123456789abcdef";
  std::array<unsigned char, kRandomBytes> bytes{};
  OIKOS_CHECK(::getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
  std::string token;
  for (const unsigned char byte : bytes) {
    token += {kDigits[byte >> 4], kDigits[byte & 0xF]};
  }
  return token;
}

/// Nothing happens if another process was faster.
void create(const std::filesystem::path& file) {
  const base::FileDescriptor made(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, kOwnerOnly));
  if (made.number() < 0) {
    if (errno != EEXIST) {
      base::throwErrno("the token cannot be written", file);
    }
    return;
  }
  const std::string line = randomToken() + '\n';
  if (::write(made.number(), line.data(), line.size()) != static_cast<ssize_t>(line.size()) || ::fsync(made.number()) != 0) {
    const int reason = errno;
    ::unlink(file.c_str());
    errno = reason;
    base::throwErrno("the token cannot be written", file);
  }
}

std::string firstLineOf(int file, const std::filesystem::path& where) {
  std::array<char, 4096> text{};
  const ssize_t size = ::read(file, text.data(), text.size());
  if (size < 0) {
    base::throwErrno("the token cannot be read", where);
  }
  const std::string line(text.data(), static_cast<std::size_t>(size));
  return line.substr(0, line.find_first_of("\r\n"));
}

}  // namespace

std::string loadOrCreateToken(const std::filesystem::path& file) {
  if (::access(file.c_str(), F_OK) != 0) {
    create(file);
  }
  const base::FileDescriptor opened = base::openFile(file, O_RDONLY);
  struct stat about {};
  if (::fstat(opened.number(), &about) != 0) {
    base::throwErrno("the token cannot be read", file);
  }
  if ((about.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    throw base::Error(base::ErrorCode::kInput, "others may read or write the token: chmod 600 is right", file.string());
  }
  std::string token = firstLineOf(opened.number(), file);
  if (token.size() < kShortest) {
    throw base::Error(base::ErrorCode::kInput,
                      "the first line is no token of at least 16 characters; remove the file to have a new one made", file.string());
  }
  return token;
}

bool equalInConstantTime(std::string_view a, std::string_view b) {
  unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[i % b.size()];
    difference = static_cast<unsigned char>(difference | (a[i] ^ other));
  }
  return difference == 0;
}

}  // namespace oikos::daemon
