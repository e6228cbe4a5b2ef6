// SPDX-License-Identifier: Apache-2.0
// PNG specification (third edition), https://www.w3.org/TR/png-3/: chunks in chapter 5, filters in chapter 9. libpng's simple interface
// has no compression level and marks 16-bit samples as linear light, which depth is not.
#include "core/recording/png_encoder.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace oikos::recording {

namespace {

using Bytes = std::vector<unsigned char>;

constexpr int kFilterCount = 5;  // none, sub, up, average, Paeth

void appendBigEndian(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<unsigned char>(value >> shift & 0xFFU));
  }
}

void appendChunk(Bytes& png, std::string_view type, const Bytes& data) {
  appendBigEndian(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t checked = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  appendBigEndian(png, libdeflate_crc32(0, png.data() + checked, png.size() - checked));
}

/// Samples in the file's order: red first, the high byte first.
void copyRow(const cv::Mat& image, int row, Bytes& samples) {
  if (image.depth() == CV_8U) {
    const int channels = image.channels();
    const auto* from = image.ptr<std::uint8_t>(row);
    auto* to = samples.data();
    for (int x = 0; x < image.cols; ++x, from += channels, to += channels) {
      for (int channel = 0; channel < channels; ++channel) {
        to[channel] = from[channel < 3 ? 2 - channel : channel];
      }
    }
    return;
  }
  const auto* value = image.ptr<std::uint16_t>(row);
  for (int x = 0; x < image.cols; ++x) {
    samples[static_cast<std::size_t>(2 * x)] = static_cast<unsigned char>(value[x] >> 8);
    samples[static_cast<std::size_t>(2 * x + 1)] = static_cast<unsigned char>(value[x] & 0xFF);
  }
}

int paeth(int left, int up, int corner) {
  const int estimate = left + up - corner;
  const int to_left = std::abs(estimate - left);
  const int to_up = std::abs(estimate - up);
  const int to_corner = std::abs(estimate - corner);
  const int nearer = to_up <= to_corner ? up : corner;
  return (to_left <= to_up) & (to_left <= to_corner) ? left : nearer;
}

/// Two rows with an empty pixel before each, so that the first one has neighbours too.
struct Rows {
  const unsigned char* row;
  const unsigned char* above;
  std::size_t pixel_bytes;
  std::size_t size;
};

/// Writes the row's bytes less their prediction, and returns the sum of the differences' absolute values.
template <class Predict>
std::uint64_t subtract(const Rows& rows, const Predict& predict, unsigned char* __restrict filtered) {
  const unsigned char* __restrict row = rows.row;
  const unsigned char* __restrict above = rows.above;
  const unsigned char* __restrict left = row - rows.pixel_bytes;
  const unsigned char* __restrict corner = above - rows.pixel_bytes;
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < rows.size; ++i) {
    filtered[i] = static_cast<unsigned char>(row[i] - predict(int{left[i]}, int{above[i]}, int{corner[i]}));
    sum += static_cast<std::uint32_t>(std::abs(int{static_cast<signed char>(filtered[i])}));
  }
  return sum;
}

std::uint64_t applyFilter(std::size_t filter, const Rows& rows, unsigned char* filtered) {
  switch (filter) {
    case 1:
      return subtract(
          rows, [](int left, int, int) { return left; }, filtered);
    case 2:
      return subtract(
          rows, [](int, int up, int) { return up; }, filtered);
    case 3:
      return subtract(
          rows, [](int left, int up, int) { return (left + up) / 2; }, filtered);
    case 4:
      return subtract(rows, paeth, filtered);
    default:
      return subtract(
          rows, [](int, int, int) { return 0; }, filtered);
  }
}

/// Each row under the filter that leaves the least sum of differences: the heuristic of chapter 12.7.
Bytes filterRows(const cv::Mat& image, bool choose) {
  const std::size_t pixel_bytes = image.elemSize();
  const std::size_t row_bytes = pixel_bytes * static_cast<std::size_t>(image.cols);
  Bytes samples(row_bytes);
  Bytes row(pixel_bytes + row_bytes, 0);
  Bytes above(row.size(), 0);
  std::array<Bytes, kFilterCount> candidates;
  candidates.fill(Bytes(row_bytes));
  Bytes stream;
  stream.reserve((row_bytes + 1) * static_cast<std::size_t>(image.rows));
  for (int y = 0; y < image.rows; ++y) {
    copyRow(image, y, samples);
    std::copy(samples.begin(), samples.end(), row.begin() + static_cast<std::ptrdiff_t>(pixel_bytes));
    const Rows rows{row.data() + pixel_bytes, above.data() + pixel_bytes, pixel_bytes, row_bytes};
    std::size_t best = 0;
    std::uint64_t best_sum = applyFilter(0, rows, candidates[0].data());
    for (std::size_t filter = 1; choose && filter < kFilterCount; ++filter) {
      const std::uint64_t sum = applyFilter(filter, rows, candidates[filter].data());
      if (sum < best_sum) {
        best = filter;
        best_sum = sum;
      }
    }
    stream.push_back(static_cast<unsigned char>(best));
    stream.insert(stream.end(), candidates[best].begin(), candidates[best].end());
    row.swap(above);
  }
  return stream;
}

Bytes compress(const Bytes& data, int level) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(libdeflate_alloc_compressor(level),
                                                                                            libdeflate_free_compressor);
  OIKOS_CHECK(compressor != nullptr);
  Bytes packed(libdeflate_zlib_compress_bound(compressor.get(), data.size()));
  const std::size_t size = libdeflate_zlib_compress(compressor.get(), data.data(), data.size(), packed.data(), packed.size());
  OIKOS_CHECK(size > 0);
  packed.resize(size);
  return packed;
}

Bytes headerOf(const cv::Mat& image) {
  Bytes header;
  appendBigEndian(header, static_cast<std::uint32_t>(image.cols));
  appendBigEndian(header, static_cast<std::uint32_t>(image.rows));
  const unsigned char depth_bits = image.depth() == CV_8U ? 8 : 16;
  const unsigned char color_type = image.channels() == 4 ? 6 : image.channels() == 3 ? 2 : 0;  // 6: with transparency
  header.insert(header.end(), {depth_bits, color_type, 0, 0, 0});
  return header;
}

}  // namespace

std::vector<unsigned char> encodePng(const cv::Mat& image, int level) {
  OIKOS_CHECK(!image.empty() && (image.type() == CV_8UC3 || image.type() == CV_8UC4 || image.type() == CV_16UC1));
  OIKOS_CHECK(level >= 0 && level <= 9);
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  appendChunk(png, "IHDR", headerOf(image));
  appendChunk(png, "IDAT", compress(filterRows(image, level > 0), level));
  appendChunk(png, "IEND", {});
  return png;
}

}  // namespace oikos::recording
