// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace oikos::recording {

/// Decodes the bytes of a 16-bit grey PNG to CV_16UC1; `file` is for messages. Throws Error{kInput} for every other kind of image (8 bits,
/// colour, interlaced) and for a truncated or corrupt one: all checksums are verified. More than twice as fast as libpng. Thread-safe.
[[nodiscard]] cv::Mat decodeDepthPng(const std::string& bytes, const std::filesystem::path& file);

}  // namespace oikos::recording
