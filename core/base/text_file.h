// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace oikos::base {

/// The whole file, byte by byte. Throws Error{kIo} that names the file and what the operating system said.
[[nodiscard]] std::string readTextFile(const std::filesystem::path& file);

}  // namespace oikos::base
