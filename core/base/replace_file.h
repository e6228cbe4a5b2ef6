// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace oikos::base {

/// Puts `content` in place of a file that reads `expected`, as writeFileAtomically() does; false: it reads something else, or another
/// program has it open for writing, and it is as that program left it. Whoever writes it at any moment, by name or into it, is not written
/// over: the two files are exchanged and what came out is looked at, and put back if it is not what was expected. Where the file system
/// cannot exchange files, what is written between the last look and the renaming is lost. One process at a time may do this to a file; for
/// a moment it has a hidden file beside it. Throws Error{kIo}.
[[nodiscard]] bool replaceFileIfUnchanged(const std::filesystem::path& file, std::string_view expected, std::string_view content);

}  // namespace oikos::base
