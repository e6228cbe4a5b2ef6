// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace oikos::daemon {

/// The token that a file holds: its first line. A missing file is made, with a random token and mode 0600. Throws Error{kInput} for a token
/// that is too short to be one or a file that anybody but its owner may read or write, Error{kIo} if it can be neither read nor made.
[[nodiscard]] std::string loadOrCreateToken(const std::filesystem::path& file);

/// Takes as long for a wrong text as for the right one.
[[nodiscard]] bool equalInConstantTime(std::string_view a, std::string_view b);

}  // namespace oikos::daemon
