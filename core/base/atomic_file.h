// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace oikos::base {

/// Creates or replaces `file` at once: whoever opens it, and whatever crashes, finds the old content or the new one, whole.
/// Writes to a hidden name beside it, brings it to the disk, renames. Throws Error{kIo}; `file` is then as it was.
void writeFileAtomically(const std::filesystem::path& file, std::string_view content);

}  // namespace oikos::base
