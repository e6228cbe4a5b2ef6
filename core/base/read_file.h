// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace oikos::base {

/// The whole content of a file, as bytes. Throws Error{kIo} with the system's reason.
[[nodiscard]] std::string readFile(const std::filesystem::path& file);

}  // namespace oikos::base
