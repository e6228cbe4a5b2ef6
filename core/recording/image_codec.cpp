// SPDX-License-Identifier: Apache-2.0
#include "core/recording/image_codec.h"

#include <png.h>
#include <turbojpeg.h>

#include <memory>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"

namespace oikos::recording {

namespace {

using base::Error;
using base::ErrorCode;

bool isJpeg(std::string_view bytes) {
  return bytes.starts_with("\xFF\xD8");
}
bool isPng(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1A\n");
}

[[noreturn]] void failTruncated(const std::string& where, const std::string& reason) {
  throw Error(ErrorCode::kInput, "truncated or corrupt image (" + reason + ")", where);
}

cv::Mat decodeJpeg(std::string_view bytes, bool color, const std::string& where) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  OIKOS_CHECK(decoder != nullptr);
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int color_space = 0;
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &subsampling, &color_space) != 0) {
    failTruncated(where, tjGetErrorStr2(decoder.get()));
  }
  cv::Mat image(height, width, color ? CV_8UC3 : CV_8UC1);
  const int failed = tjDecompress2(decoder.get(), data, bytes.size(), image.data, width, static_cast<int>(image.step[0]), height,
                                   color ? TJPF_BGR : TJPF_GRAY, TJFLAG_STOPONWARNING);
  if (failed != 0) {
    failTruncated(where, tjGetErrorStr2(decoder.get()));
  }
  return image;
}

/// libpng's description of an image, freed whatever happens.
struct PngImage {
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  png_image image{};
};

cv::Mat decodePng(std::string_view bytes, const std::string& where) {
  constexpr int kMaxSide_px = 1 << 15;
  PngImage png;
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0) {
    failTruncated(where, png.image.message);
  }
  if (png.image.width > kMaxSide_px || png.image.height > kMaxSide_px) {
    throw Error(ErrorCode::kInput, "an image of " + std::to_string(png.image.width) + " x " + std::to_string(png.image.height) + " pixels",
                where);
  }
  png.image.format = PNG_FORMAT_BGR;
  png.image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  cv::Mat bgr(static_cast<int>(png.image.height), static_cast<int>(png.image.width), CV_8UC3);
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&png.image, &black, bgr.data, static_cast<png_int_32>(bgr.step[0]), nullptr) == 0) {
    failTruncated(where, png.image.message);
  }
  return bgr;
}

[[noreturn]] void failForeign(std::string_view bytes, const std::string& where) {
  throw Error(ErrorCode::kInput, bytes.empty() ? "the file is empty" : "neither a JPEG nor a PNG file", where);
}

}  // namespace

cv::Mat decodeColorImage(std::string_view bytes, const std::string& where) {
  if (isJpeg(bytes)) {
    return decodeJpeg(bytes, true, where);
  }
  if (isPng(bytes)) {
    return decodePng(bytes, where);
  }
  failForeign(bytes, where);
}

cv::Mat decodeGrayImage(std::string_view bytes, const std::string& where) {
  if (isJpeg(bytes)) {
    return decodeJpeg(bytes, false, where);
  }
  if (isPng(bytes)) {
    cv::Mat gray;
    cv::cvtColor(decodePng(bytes, where), gray, cv::COLOR_BGR2GRAY);
    return gray;
  }
  failForeign(bytes, where);
}

std::vector<unsigned char> encodeJpeg(const cv::Mat& bgr, int quality) {
  OIKOS_CHECK(bgr.type() == CV_8UC3);
  const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
  OIKOS_CHECK(encoder != nullptr);
  std::vector<unsigned char> bytes(tjBufSize(bgr.cols, bgr.rows, TJSAMP_420));
  unsigned char* data = bytes.data();
  unsigned long size = bytes.size();
  const int failed = tjCompress2(encoder.get(), bgr.data, bgr.cols, static_cast<int>(bgr.step[0]), bgr.rows, TJPF_BGR, &data, &size,
                                 TJSAMP_420, quality, TJFLAG_NOREALLOC);
  OIKOS_CHECK(failed == 0);
  bytes.resize(size);
  return bytes;
}

}  // namespace oikos::recording
