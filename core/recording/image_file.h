// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace oikos::recording {

// All of these throw Error{kIo} if the file cannot be opened and Error{kInput} if it is not a complete image of the right kind: a truncated
// or corrupt file is an error even where its decoder would fill in what is missing. Thread-safe.

/// CV_8UC1; of a JPEG only the luma is decoded.
[[nodiscard]] cv::Mat readGrayImage(const std::filesystem::path& file);
/// CV_8UC3, BGR.
[[nodiscard]] cv::Mat readColorImage(const std::filesystem::path& file);
/// CV_16UC1, as stored; from a 16-bit grey PNG.
[[nodiscard]] cv::Mat readDepthImage(const std::filesystem::path& file);

}  // namespace oikos::recording
