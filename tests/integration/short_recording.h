// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "tests/support/temporary_folder.h"

namespace oikos::test {

/// Links to the first frames of the recording `kitchen` below $OIKOS_DATA: short enough to be mapped many times.
[[nodiscard]] std::optional<std::filesystem::path> findShortRecording(const TemporaryFolder& folder, int frames);

}  // namespace oikos::test
