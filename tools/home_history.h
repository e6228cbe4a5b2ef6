// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "semantic/history/history.h"

namespace oikos::tools {

/// The history of a home, to be appended to; no lock is taken. Throws Error{kIo} where there is no such folder, Error{kInput} where it has
/// no history yet.
[[nodiscard]] std::unique_ptr<semantic::History> openHistory(const std::filesystem::path& home);

}  // namespace oikos::tools
