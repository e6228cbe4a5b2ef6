// SPDX-License-Identifier: Apache-2.0
// JPEG is decoded by libjpeg-turbo itself: OpenCV's wrapper hands out a half-grey picture for a truncated file without a word.
#include "core/recording/image_file.h"

#include <turbojpeg.h>

#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "core/recording/depth_png.h"

namespace oikos::recording {

namespace {

using base::Error;
using base::ErrorCode;

bool startsWith(const std::string& bytes, std::string_view signature) {
  return bytes.compare(0, signature.size(), signature) == 0;
}
bool isJpeg(const std::string& bytes) {
  return startsWith(bytes, "\xFF\xD8");
}
bool isPng(const std::string& bytes) {
  return startsWith(bytes, "\x89PNG\r\n\x1A\n");
}

[[noreturn]] void failTruncated(const std::filesystem::path& file, const std::string& reason) {
  throw Error(ErrorCode::kInput, "truncated or corrupt image (" + reason + ")", file.string());
}

cv::Mat decodeJpeg(const std::string& bytes, bool color, const std::filesystem::path& file) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  OIKOS_CHECK(decoder != nullptr);
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int color_space = 0;
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &subsampling, &color_space) != 0) {
    failTruncated(file, tjGetErrorStr2(decoder.get()));
  }
  cv::Mat image(height, width, color ? CV_8UC3 : CV_8UC1);
  const int failed = tjDecompress2(decoder.get(), data, bytes.size(), image.data, width, static_cast<int>(image.step[0]), height,
                                   color ? TJPF_BGR : TJPF_GRAY, TJFLAG_STOPONWARNING);
  if (failed != 0) {
    failTruncated(file, tjGetErrorStr2(decoder.get()));
  }
  return image;
}

/// The PNG decoder does report a corrupt file, as an empty image, but it prints too: what was cut off is found out without it.
cv::Mat decodePng(const std::string& bytes, int mode, const std::filesystem::path& file) {
  if (bytes.rfind("IEND") == std::string::npos) {
    failTruncated(file, "the file ends early");
  }
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));  // only read
  cv::Mat image = cv::imdecode(encoded, mode);
  if (image.empty()) {
    failTruncated(file, "the PNG decoder gave up");
  }
  return image;
}

cv::Mat readImage(const std::filesystem::path& file, bool color) {
  const std::string bytes = base::readFile(file);
  if (isJpeg(bytes)) {
    return decodeJpeg(bytes, color, file);
  }
  if (isPng(bytes)) {
    return decodePng(bytes, color ? cv::IMREAD_COLOR : cv::IMREAD_GRAYSCALE, file);
  }
  throw Error(ErrorCode::kInput, bytes.empty() ? "the file is empty" : "neither a JPEG nor a PNG file", file.string());
}

}  // namespace

cv::Mat readGrayImage(const std::filesystem::path& file) {
  return readImage(file, false);
}

cv::Mat readColorImage(const std::filesystem::path& file) {
  return readImage(file, true);
}

cv::Mat readDepthImage(const std::filesystem::path& file) {
  return decodeDepthPng(base::readFile(file), file);
}

}  // namespace oikos::recording
