// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace oikos::recording {

// JPEG by libjpeg-turbo and PNG by libpng themselves: OpenCV's wrapper hands out a half-grey picture for a truncated JPEG without a word,
// and brings a hundred libraries along. `where` is for messages. Thread-safe.

/// CV_8UC3, BGR, from the bytes of a JPEG or a PNG of any depth; what is transparent is shown on black. Throws Error{kInput} if they are
/// not a complete image: a truncated or corrupt one is an error even where its decoder would fill in what is missing.
[[nodiscard]] cv::Mat decodeColorImage(std::string_view bytes, const std::string& where);
/// CV_8UC1; of a JPEG only the luma is decoded. Throws as decodeColorImage.
[[nodiscard]] cv::Mat decodeGrayImage(std::string_view bytes, const std::string& where);

/// From CV_8UC3, BGR; quality of 1 to 100.
[[nodiscard]] std::vector<unsigned char> encodeJpeg(const cv::Mat& bgr, int quality);

}  // namespace oikos::recording
