// SPDX-License-Identifier: Apache-2.0
// "Portable Network Graphics (PNG) Specification (Second Edition)", W3C 2003, https://www.w3.org/TR/2003/REC-PNG-20031110/ : the part of it
// that depth images use. libpng undoes the filters of 16-bit grey byte by byte and inflates with zlib; both together are most of the
// time that reading a frame takes.
#include "core/recording/depth_png.h"

#include <libdeflate.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

#include "core/base/error.h"

namespace oikos::recording {

namespace {

using base::Error;
using base::ErrorCode;

constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";
constexpr std::size_t kPixelBytes = 2;

std::uint32_t bigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

struct Chunk {
  std::string_view type;
  std::string_view data;
};

/// Walks through the chunks of a file and checks length and checksum of each.
class ChunkReader {
 public:
  ChunkReader(std::string_view bytes, const std::string& where) : rest_(bytes), where_(where) {
    if (!bytes.starts_with(kSignature)) {
      throw Error(ErrorCode::kInput, bytes.empty() ? "the file is empty" : "not a PNG file; depth must be a 16-bit grey PNG", where);
    }
    rest_.remove_prefix(kSignature.size());
  }

  Chunk next() {
    constexpr std::size_t kFrameBytes = 12;  // length, type and checksum
    if (rest_.size() < kFrameBytes || bigEndian(rest_) > rest_.size() - kFrameBytes) {
      fail("the file ends early");
    }
    const std::size_t length = bigEndian(rest_);
    const std::string_view checked = rest_.substr(4, length + 4);
    if (libdeflate_crc32(0, checked.data(), checked.size()) != bigEndian(rest_.substr(length + 8))) {
      fail("a checksum is wrong");
    }
    rest_.remove_prefix(length + kFrameBytes);
    return {checked.substr(0, 4), checked.substr(4)};
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(ErrorCode::kInput, "truncated or corrupt image (" + reason + ")", where_);
  }

 private:
  std::string_view rest_;
  const std::string& where_;
};

/// An empty image of the header's size.
cv::Mat readHeader(const Chunk& chunk, const ChunkReader& reader, const std::string& where) {
  constexpr std::size_t kHeaderBytes = 13;
  constexpr std::uint32_t kLargestSize_px = 16384;
  if (chunk.type != "IHDR" || chunk.data.size() != kHeaderBytes) {
    reader.fail("it does not begin with its header");
  }
  const std::uint32_t width = bigEndian(chunk.data);
  const std::uint32_t height = bigEndian(chunk.data.substr(4));
  const int bits = chunk.data[8];
  const int color_type = chunk.data[9];
  const int interlace = chunk.data[12];
  if (bits != 16) {
    throw Error(ErrorCode::kInput, std::to_string(bits) + "-bit depth; depth must be a 16-bit grey PNG", where);
  }
  if (color_type != 0 || interlace != 0) {
    throw Error(ErrorCode::kInput,
                std::string(color_type != 0 ? "not a grey" : "an interlaced") + " PNG; depth must be a plain 16-bit grey PNG", where);
  }
  if (width == 0 || height == 0 || width > kLargestSize_px || height > kLargestSize_px) {
    reader.fail("its size is " + std::to_string(width) + "x" + std::to_string(height));
  }
  return cv::Mat(static_cast<int>(height), static_cast<int>(width), CV_16UC1);
}

std::string inflate(const std::string& compressed, std::size_t size, const ChunkReader& reader) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(libdeflate_alloc_decompressor(),
                                                                                              libdeflate_free_decompressor);
  OIKOS_CHECK(inflater != nullptr);
  std::string data(size, '\0');
  if (libdeflate_zlib_decompress(inflater.get(), compressed.data(), compressed.size(), data.data(), size, nullptr) != LIBDEFLATE_SUCCESS) {
    reader.fail("its pixels cannot be unpacked");
  }
  return data;
}

int paethPredictor(int left, int above, int corner) {
  const int to_left = std::abs(above - corner);
  const int to_above = std::abs(left - corner);
  const int to_corner = std::abs(left + above - 2 * corner);
  const int other = to_above <= to_corner ? above : corner;
  const int other_distance = to_above <= to_corner ? to_above : to_corner;
  return to_left <= other_distance ? left : other;
}

using Byte = unsigned char;

/// The two bytes of a pixel are predicted apart; written out so that both chains of dependent steps run at once.
void undoPaeth(Byte* row, const Byte* above, std::size_t size) {
  int high = 0;
  int low = 0;
  int corner_high = 0;
  int corner_low = 0;
  for (std::size_t i = 0; i < size; i += kPixelBytes) {
    const int above_high = above[i];
    const int above_low = above[i + 1];
    high = (row[i] + paethPredictor(high, above_high, corner_high)) & 0xFF;
    low = (row[i + 1] + paethPredictor(low, above_low, corner_low)) & 0xFF;
    row[i] = static_cast<Byte>(high);
    row[i + 1] = static_cast<Byte>(low);
    corner_high = above_high;
    corner_low = above_low;
  }
}

void undoSub(Byte* row, std::size_t size) {
  for (std::size_t i = kPixelBytes; i < size; ++i) {
    row[i] = static_cast<Byte>(row[i] + row[i - kPixelBytes]);
  }
}

void undoUp(Byte* row, const Byte* above, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    row[i] = static_cast<Byte>(row[i] + above[i]);
  }
}

void undoAverage(Byte* row, const Byte* above, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    const int left = i < kPixelBytes ? 0 : row[i - kPixelBytes];
    row[i] = static_cast<Byte>(row[i] + (left + above[i]) / 2);
  }
}

void undoFilter(int filter, Byte* row, const Byte* above, std::size_t size, const ChunkReader& reader) {
  switch (filter) {
    case 0:
      return;
    case 1:
      return undoSub(row, size);
    case 2:
      return undoUp(row, above, size);
    case 3:
      return undoAverage(row, above, size);
    case 4:
      return undoPaeth(row, above, size);
    default:
      reader.fail("unknown filter " + std::to_string(filter));
  }
}

void toNative(const Byte* row, cv::Mat& depth, int v) {
  auto* pixels = depth.ptr<std::uint16_t>(v);
  for (int u = 0; u < depth.cols; ++u) {
    std::uint16_t stored = 0;
    std::memcpy(&stored, row + kPixelBytes * static_cast<std::size_t>(u), kPixelBytes);
    pixels[u] = std::endian::native == std::endian::big ? stored : static_cast<std::uint16_t>(stored << 8 | stored >> 8);
  }
}

}  // namespace

cv::Mat decodeDepthPng(std::string_view bytes, const std::string& where) {
  ChunkReader reader(bytes, where);
  cv::Mat depth = readHeader(reader.next(), reader, where);
  std::string compressed;
  for (Chunk chunk = reader.next(); chunk.type != "IEND"; chunk = reader.next()) {
    if (chunk.type == "IDAT") {
      compressed += chunk.data;
    }
  }
  const std::size_t row_bytes = kPixelBytes * static_cast<std::size_t>(depth.cols);
  std::string rows = inflate(compressed, (row_bytes + 1) * static_cast<std::size_t>(depth.rows), reader);
  const std::string nothing(row_bytes, '\0');
  const auto* above = reinterpret_cast<const Byte*>(nothing.data());
  for (int v = 0; v < depth.rows; ++v) {
    auto* row = reinterpret_cast<Byte*>(rows.data()) + (row_bytes + 1) * static_cast<std::size_t>(v);
    undoFilter(row[0], row + 1, above, row_bytes, reader);
    toNative(row + 1, depth, v);
    above = row + 1;
  }
  return depth;
}

}  // namespace oikos::recording
