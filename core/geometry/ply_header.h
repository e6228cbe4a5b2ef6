// SPDX-License-Identifier: Apache-2.0
// What a PLY file says of itself, and its bytes. Included by this folder's sources only.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oikos::geometry {

static_assert(std::endian::native == std::endian::little, "binary PLY is read and written as it lies in memory");

enum class PlyScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

struct PlyProperty {
  std::string name;
  PlyScalar scalar = PlyScalar::kFloat32;
  std::optional<PlyScalar> list_count;  ///< set: a list whose length is of this type
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool ascii = false;
  std::vector<PlyElement> elements;
};

/// The file's bytes, a read position and the words for errors at it. Errors are Error{kInput}.
class PlySource {
 public:
  /// Reads all of it. Throws Error{kIo}.
  explicit PlySource(const std::filesystem::path& file);

  /// Error{kInput} with where the reader stands: the line, or the byte of a binary body.
  [[noreturn]] void fail(const std::string& what) const;

  /// Without its end.
  std::string_view nextLine();

  /// The header has ended.
  void startBody(bool ascii) { by_line_ = ascii; }

  /// As wide as its type says, little-endian.
  double nextBinary(PlyScalar scalar) {
    switch (scalar) {
      case PlyScalar::kInt8:
        return take<std::int8_t>();
      case PlyScalar::kUint8:
        return take<std::uint8_t>();
      case PlyScalar::kInt16:
        return take<std::int16_t>();
      case PlyScalar::kUint16:
        return take<std::uint16_t>();
      case PlyScalar::kInt32:
        return take<std::int32_t>();
      case PlyScalar::kUint32:
        return take<std::uint32_t>();
      case PlyScalar::kFloat32:
        return static_cast<double>(take<float>());
      case PlyScalar::kFloat64:
        break;
    }
    return take<double>();
  }

  /// Values stand one record a line; a line is opened by the first value asked of it.
  double nextAscii();

  [[nodiscard]] std::size_t bytesLeft() const { return bytes_.size() - position_; }

 private:
  template <typename T>
  T take() {
    if (bytesLeft() < sizeof(T)) {
      fail("the file ends here, more was announced");
    }
    T value;
    std::memcpy(&value, bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  std::string name_;
  std::string bytes_;
  std::size_t position_ = 0;
  int line_ = 0;
  bool by_line_ = true;
  std::string_view rest_;
};

/// Reads up to `end_header`, after which the body starts. Throws Error{kInput}.
[[nodiscard]] PlyHeader readPlyHeader(PlySource& source);

}  // namespace oikos::geometry
