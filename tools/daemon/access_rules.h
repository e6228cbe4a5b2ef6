// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace oikos::daemon {

enum class Access { kOpen, kRead, kWrite };

/// Who may ask for what.
struct AccessRules {
  std::string listen_host;        ///< as it was given: a `Host` that the daemon answers to
  std::string token;              ///< for writing
  bool read_needs_token = false;  ///< anybody's machine can reach the daemon

  /// Whether the header names this daemon, with any port: `localhost`, an address in digits (on loopback: a loopback address) or the name
  /// that was listened at. A page from elsewhere that made its own name point here (DNS rebinding) sends that name.
  [[nodiscard]] bool allowsHost(std::string_view header) const;
  /// Whether the `Authorization` header is enough.
  [[nodiscard]] bool allows(Access access, std::string_view authorization) const;
};

}  // namespace oikos::daemon
