// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/base/posix_file.h"

namespace oikos::daemon {

/// Where a server listens: `127.0.0.1:7777`, `[::1]:0`, `localhost:7777`.
struct ListenAddress {
  std::string host;
  int port = 0;  ///< 0: any that is free

  [[nodiscard]] std::string text() const;  ///< with an IPv6 address in brackets
};

/// Throws Error{kUsage}.
[[nodiscard]] ListenAddress parseListenAddress(const std::string& text);

/// `localhost`, 127.0.0.0/8 and ::1: nobody else's machine gets there.
[[nodiscard]] bool isLoopback(const std::string& host);
/// An IPv4 or IPv6 address in digits.
[[nodiscard]] bool isAddress(const std::string& host);

/// A socket that listens there; `address.port` becomes the real one. Throws Error{kIo} naming address and port.
[[nodiscard]] base::FileDescriptor listenAt(ListenAddress& address);

}  // namespace oikos::daemon
