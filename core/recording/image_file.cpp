// SPDX-License-Identifier: Apache-2.0
#include "core/recording/image_file.h"

#include "core/base/read_file.h"
#include "core/recording/depth_png.h"
#include "core/recording/image_codec.h"

namespace oikos::recording {

cv::Mat readGrayImage(const std::filesystem::path& file) {
  return decodeGrayImage(base::readFile(file), file.string());
}

cv::Mat readColorImage(const std::filesystem::path& file) {
  return decodeColorImage(base::readFile(file), file.string());
}

cv::Mat readDepthImage(const std::filesystem::path& file) {
  return decodeDepthPng(base::readFile(file), file.string());
}

}  // namespace oikos::recording
