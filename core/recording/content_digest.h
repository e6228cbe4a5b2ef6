// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace oikos::recording {

/// What tells a recording from every other, whatever its folder is called: SHA-256 over its calibration, lists, and the stamps and images
/// of its frames, in their order; 64 hexadecimal digits. Files beside them (truth, odometry) do not count. Reads every file once. Throws as
/// openRecording, and Error{kIo} for an image that is listed and cannot be read.
[[nodiscard]] std::string contentDigest(const std::filesystem::path& folder);

}  // namespace oikos::recording
