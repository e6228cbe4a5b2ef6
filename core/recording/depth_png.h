// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

namespace oikos::recording {

/// Decodes the bytes of a 16-bit grey PNG to CV_16UC1; `where` is for messages. Throws Error{kInput} for every other kind of image (8 bits,
/// colour, interlaced) and for a truncated or corrupt one: all checksums are verified. More than twice as fast as libpng. Thread-safe.
[[nodiscard]] cv::Mat decodeDepthPng(std::string_view bytes, const std::string& where);

}  // namespace oikos::recording
