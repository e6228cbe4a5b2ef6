// SPDX-License-Identifier: Apache-2.0
#include "core/recording/image_file.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cstdint>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/read_file.h"
#include "core/recording/depth_png.h"
#include "core/recording/image_codec.h"
#include "core/recording/png_encoder.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_recording.h"
#include "tests/support/temporary_folder.h"

namespace oikos::recording {
namespace {

using base::ErrorCode;
using test::expectError;

class ImageFile : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path save(const std::string& name, const cv::Mat& image, const std::vector<int>& options = {}) const {
    const auto file = folder_.path() / name;
    EXPECT_TRUE(cv::imwrite(file.string(), image, options));
    return file;
  }
  test::TemporaryFolder folder_;
};

double largestDifference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF);
}

cv::Mat roughDepth() {
  cv::Mat depth(47, 61, CV_16UC1);
  std::uint32_t state = 1;
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      state = state * 1664525U + 1013904223U;
      depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(u * 700 + v * 300 + (state >> 24) * (u % 3 == 0 ? 9 : 0));
    }
  }
  return depth;
}

TEST_F(ImageFile, JpegAndPngColor) {
  const cv::Mat color = test::tinyColor(3);
  const auto png = save("c.png", color);
  EXPECT_EQ(largestDifference(readColorImage(png), color), 0.0);
  const auto jpeg = save("c.jpg", color, {cv::IMWRITE_JPEG_QUALITY, 95});
  EXPECT_EQ(largestDifference(readColorImage(jpeg), cv::imread(jpeg.string(), cv::IMREAD_COLOR)), 0.0);
  EXPECT_EQ(largestDifference(readGrayImage(jpeg), cv::imread(jpeg.string(), cv::IMREAD_GRAYSCALE)), 0.0);
  EXPECT_LE(largestDifference(readGrayImage(png), cv::imread(png.string(), cv::IMREAD_GRAYSCALE)), 1.0);  // rounded
}

TEST_F(ImageFile, PngOfEveryKindAgreesWithOpenCv) {
  cv::Mat gray;
  cv::cvtColor(test::tinyColor(3), gray, cv::COLOR_BGR2GRAY);
  cv::Mat deep;
  test::tinyColor(3).convertTo(deep, CV_16UC3, 257.0);
  cv::Mat opaque;
  cv::cvtColor(test::tinyColor(3), opaque, cv::COLOR_BGR2BGRA);
  for (const cv::Mat& image : {gray, deep, opaque}) {
    const auto file = save("c.png", image);
    EXPECT_EQ(largestDifference(readColorImage(file), cv::imread(file.string(), cv::IMREAD_COLOR)), 0.0) << image.type();
  }
}

TEST_F(ImageFile, WhatIsEncodedIsReadBackByOthers) {
  const std::vector<unsigned char> depth = encodePng(roughDepth(), 1);
  EXPECT_EQ(largestDifference(cv::imdecode(depth, cv::IMREAD_UNCHANGED), roughDepth()), 0.0);
  const std::string bytes(depth.begin(), depth.end());
  EXPECT_EQ(largestDifference(decodeDepthPng(bytes, "depth"), roughDepth()), 0.0);

  cv::Mat half_seen(3, 5, CV_8UC4, cv::Scalar(10, 60, 200, 56));
  half_seen.at<cv::Vec4b>(1, 2) = {1, 2, 3, 255};
  EXPECT_EQ(largestDifference(cv::imdecode(encodePng(half_seen, 1), cv::IMREAD_UNCHANGED), half_seen), 0.0);

  cv::Mat smooth;
  cv::resize(test::tinyColor(2), smooth, cv::Size(64, 48), 0.0, 0.0, cv::INTER_CUBIC);
  EXPECT_LT(cv::norm(cv::imdecode(encodeJpeg(smooth, 95), cv::IMREAD_COLOR), smooth, cv::NORM_L1) / (64.0 * 48.0 * 3.0), 6.0);
}

void appendBigEndian(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(value >> shift & 0xFF);
  }
}

void appendChunk(std::string& bytes, const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  appendBigEndian(bytes, static_cast<std::uint32_t>(data.size()));
  bytes += checked;
  appendBigEndian(bytes, libdeflate_crc32(0, checked.data(), checked.size()));
}

/// A PNG whose rows claim to be filtered in this way; what they then mean is for libpng to say.
std::string encodeDepth(const cv::Mat& depth, int filter) {
  std::string rows;
  for (int v = 0; v < depth.rows; ++v) {
    rows += static_cast<char>(filter);
    rows.append(reinterpret_cast<const char*>(depth.ptr(v)), depth.elemSize() * static_cast<std::size_t>(depth.cols));
  }
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(1);
  std::string packed(libdeflate_zlib_compress_bound(compressor, rows.size()), '\0');
  packed.resize(libdeflate_zlib_compress(compressor, rows.data(), rows.size(), packed.data(), packed.size()));
  libdeflate_free_compressor(compressor);
  std::string header;
  appendBigEndian(header, static_cast<std::uint32_t>(depth.cols));
  appendBigEndian(header, static_cast<std::uint32_t>(depth.rows));
  header += std::string("\x10\0\0\0\0", 5);  // 16 bits, grey, deflate, adaptive filters, not interlaced
  std::string bytes = "\x89PNG\r\n\x1A\n";
  appendChunk(bytes, "IHDR", header);
  appendChunk(bytes, "IDAT", packed);
  appendChunk(bytes, "IEND", "");
  return bytes;
}

TEST_F(ImageFile, DepthWithTheFiltersOfAnEncoder) {
  const cv::Mat depth = roughDepth();
  for (const int strategy : {cv::IMWRITE_PNG_STRATEGY_DEFAULT, cv::IMWRITE_PNG_STRATEGY_FILTERED, cv::IMWRITE_PNG_STRATEGY_RLE}) {
    const auto file = save("d.png", depth, {cv::IMWRITE_PNG_STRATEGY, strategy});
    EXPECT_EQ(largestDifference(readDepthImage(file), depth), 0.0) << strategy;
  }
}

TEST_F(ImageFile, DepthWithEveryFilterAgreesWithLibpng) {
  for (int filter = 0; filter <= 4; ++filter) {
    const auto file = folder_.write("d.png", encodeDepth(roughDepth(), filter));
    const cv::Mat by_libpng = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    ASSERT_FALSE(by_libpng.empty());
    EXPECT_EQ(largestDifference(readDepthImage(file), by_libpng), 0.0) << filter;
  }
  const auto unknown = folder_.write("d.png", encodeDepth(roughDepth(), 5));
  expectError(ErrorCode::kInput, {"unknown filter 5"}, [&] { (void)readDepthImage(unknown); });
}

TEST_F(ImageFile, EveryTruncationIsNoticed) {
  const auto jpeg = save("c.jpg", test::tinyColor(1));
  const auto png = save("c.png", test::tinyColor(1));
  const auto depth = save("d.png", roughDepth());
  for (const auto& file : {jpeg, png, depth}) {
    const std::string bytes = base::readFile(file);
    for (const double share : {0.0, 0.02, 0.3, 0.7, 0.95}) {
      const auto cut =
          folder_.write("cut", std::string_view(bytes).substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
      expectError(ErrorCode::kInput, {"cut"}, [&] { file == depth ? (void)readDepthImage(cut) : (void)readGrayImage(cut); });
      if (file != depth) {
        expectError(ErrorCode::kInput, {"cut"}, [&] { (void)readColorImage(cut); });
      }
    }
  }
}

TEST_F(ImageFile, EveryFlippedByteOfDepthIsNoticed) {
  const std::string bytes = base::readFile(save("d.png", roughDepth()));
  for (std::size_t i = 0; i < bytes.size(); i += 7) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    const auto file = folder_.write("changed.png", changed);
    EXPECT_THROW((void)readDepthImage(file), base::Error) << "byte " << i;
  }
}

TEST_F(ImageFile, DepthMustBeSixteenBitGray) {
  const auto eight = save("8.png", cv::Mat(8, 8, CV_8UC1, cv::Scalar(3)));
  expectError(ErrorCode::kInput, {"8.png", "8-bit depth", "16-bit grey PNG"}, [&] { (void)readDepthImage(eight); });
  const auto color = save("rgb16.png", cv::Mat(8, 8, CV_16UC3, cv::Scalar(3, 4, 5)));
  expectError(ErrorCode::kInput, {"rgb16.png", "not a grey PNG"}, [&] { (void)readDepthImage(color); });
  const auto jpeg = save("d.jpg", cv::Mat(8, 8, CV_8UC1, cv::Scalar(3)));
  expectError(ErrorCode::kInput, {"d.jpg", "not a PNG"}, [&] { (void)readDepthImage(jpeg); });
}

TEST_F(ImageFile, OtherFilesAndNone) {
  const auto text = folder_.write("c.jpg", "hello");
  expectError(ErrorCode::kInput, {"c.jpg", "neither a JPEG nor a PNG"}, [&] { (void)readGrayImage(text); });
  const auto empty = folder_.write("e.jpg", "");
  expectError(ErrorCode::kInput, {"e.jpg", "empty"}, [&] { (void)readGrayImage(empty); });
  expectError(ErrorCode::kIo, {"absent.png"}, [&] { (void)readDepthImage(folder_.path() / "absent.png"); });
}

}  // namespace
}  // namespace oikos::recording
