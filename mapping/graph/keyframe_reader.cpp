// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/keyframe_reader.h"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/geometry/pose_numbers.h"
#include "core/recording/depth_png.h"
#include "core/recording/image_codec.h"
#include "mapping/graph/keyframe_rows.h"
#include "mapping/graph/sqlite_statement.h"

namespace oikos::mapping {

namespace {

constexpr const char* kSelectColor = "SELECT color_jpeg FROM keyframe WHERE id = ?";
constexpr const char* kSelectDepth = "SELECT depth_png FROM keyframe WHERE id = ?";

template <class Row>
std::vector<Row> fromBlob(const std::vector<unsigned char>& blob, const std::string& where) {
  if (blob.size() % sizeof(Row) != 0) {
    throw base::Error(base::ErrorCode::kInput,
                      "a blob of " + std::to_string(blob.size()) + " bytes, a multiple of " + std::to_string(sizeof(Row)) + " expected",
                      where);
  }
  std::vector<Row> rows(blob.size() / sizeof(Row));
  if (!rows.empty()) {
    std::memcpy(rows.data(), blob.data(), blob.size());
  }
  return rows;
}

std::string_view textOf(const std::vector<unsigned char>& blob) {
  return {reinterpret_cast<const char*>(blob.data()), blob.size()};
}

cv::Mat decodeDepth(const std::vector<unsigned char>& bytes, const std::string& where) {
  const cv::Mat units = recording::decodeDepthPng(textOf(bytes), where);
  cv::Mat depth_m(units.size(), CV_32FC1);
  for (int y = 0; y < units.rows; ++y) {
    for (int x = 0; x < units.cols; ++x) {
      const std::uint16_t value = units.at<std::uint16_t>(y, x);
      depth_m.at<float>(y, x) = value == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value / kDepthUnitsPerMetre);
    }
  }
  return depth_m;
}

Eigen::Isometry3d decodePose(const std::vector<double>& numbers, const std::string& where) {
  std::array<double, 7> seven{};
  if (numbers.size() != seven.size()) {
    throw base::Error(base::ErrorCode::kInput, "a pose of " + std::to_string(numbers.size()) + " numbers, 7 expected", where);
  }
  std::copy(numbers.begin(), numbers.end(), seven.begin());
  const auto T_map_camera = geometry::poseFromNumbers(seven);
  if (!T_map_camera) {
    throw base::Error(base::ErrorCode::kInput, "a pose whose quaternion has not norm 1, or whose numbers are not finite", where);
  }
  return *T_map_camera;
}

std::string nameOf(const std::string& file, int id) {
  return file + ": keyframe " + std::to_string(id);
}

/// Everything but the pictures.
StoredKeyframe readRow(const Statement& row, const std::string& file) {
  StoredKeyframe k;
  k.id = static_cast<int>(row.integer(0));
  const std::string where = nameOf(file, k.id);
  k.frame = static_cast<int>(row.integer(1));
  k.stamp_ns = row.integer(2);
  k.T_map_camera = decodePose(fromBlob<double>(row.blob(3), where), where);
  for (const FeatureRow& f : fromBlob<FeatureRow>(row.blob(4), where)) {
    k.features.pixel.emplace_back(f.pixel[0], f.pixel[1]);
    k.features.point_camera.emplace_back(f.point_camera[0], f.point_camera[1], f.point_camera[2]);
    k.features.descriptor.push_back({f.descriptor[0], f.descriptor[1], f.descriptor[2], f.descriptor[3]});
  }
  for (const LandmarkRow& l : fromBlob<LandmarkRow>(row.blob(5), where)) {
    k.landmarks.push_back({k.id,
                           {l.pixel[0], l.pixel[1]},
                           l.inverse_depth,
                           l.inverse_depth,
                           l.sigma,
                           {l.inverse_depth_gradient[0], l.inverse_depth_gradient[1]}});
  }
  return k;
}

/// The statement at the one row that has this key.
Statement findMeta(sqlite3* database, const std::string& where, const char* key) {
  Statement select(database, "SELECT value FROM meta WHERE key = ?", where);
  select.bind(1, key);
  if (!select.step()) {
    throw base::Error(base::ErrorCode::kInput, std::string("no '") + key + "' in table meta: not a keyframe store", where);
  }
  return select;
}

double metaNumber(sqlite3* database, const std::string& where, const char* key) {
  return findMeta(database, where, key).real(0);
}

void checkFormat(sqlite3* database, const std::string& where) {
  if (const std::string format = findMeta(database, where, "format").text(0); format != kFormat) {
    throw base::Error(base::ErrorCode::kInput, "format '" + format + "', '" + kFormat + "' expected", where);
  }
  if (const double version = metaNumber(database, where, "version"); version > kVersion) {
    throw base::Error(base::ErrorCode::kInput,
                      "version " + base::toText(version) + ", this program reads up to " + std::to_string(kVersion), where);
  }
}

}  // namespace

void KeyframeReader::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

KeyframeReader::KeyframeReader(const std::filesystem::path& file) : file_(file) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  database_.reset(opened);
  const std::string where = file.string();
  if (code != SQLITE_OK) {
    throw base::Error(base::ErrorCode::kIo, sqlite3_errstr(code), where);
  }
  checkFormat(opened, where);
  camera_ = {static_cast<int>(metaNumber(opened, where, "width_px")),
             static_cast<int>(metaNumber(opened, where, "height_px")),
             metaNumber(opened, where, "fx_px"),
             metaNumber(opened, where, "fy_px"),
             metaNumber(opened, where, "cx_px"),
             metaNumber(opened, where, "cy_px")};
}

std::vector<StoredKeyframe> KeyframeReader::readKeyframes() const {
  const std::lock_guard lock(mutex_);
  const std::string where = file_.string();
  Statement rows(database_.get(), "SELECT id, frame, stamp_ns, t_map_camera, features, landmarks FROM keyframe ORDER BY id", where);
  std::vector<StoredKeyframe> keyframes;
  while (rows.step()) {
    keyframes.push_back(readRow(rows, where));
  }
  return keyframes;
}

std::vector<unsigned char> KeyframeReader::readBlob(const char* select, int id) const {
  const std::lock_guard lock(mutex_);
  Statement row(database_.get(), select, nameOf(file_.string(), id));
  row.bind(1, std::int64_t{id});
  OIKOS_CHECK(row.step());
  return row.blob(0);
}

cv::Mat KeyframeReader::readColor(int id) const {
  return recording::decodeColorImage(textOf(readBlob(kSelectColor, id)), nameOf(file_.string(), id));
}

cv::Mat KeyframeReader::readGray(int id) const {
  return recording::decodeGrayImage(textOf(readBlob(kSelectColor, id)), nameOf(file_.string(), id));
}

cv::Mat KeyframeReader::readDepth(int id) const {
  return decodeDepth(readBlob(kSelectDepth, id), nameOf(file_.string(), id));
}

EncodedPictures KeyframeReader::readPictures(int id) const {
  return {readBlob(kSelectColor, id), readBlob(kSelectDepth, id)};
}

KeyframeStore readKeyframeStore(const std::filesystem::path& file) {
  const KeyframeReader reader(file);
  KeyframeStore store{reader.camera(), reader.readKeyframes()};
  for (StoredKeyframe& keyframe : store.keyframes) {
    keyframe.color = reader.readColor(keyframe.id);
    keyframe.depth_m = reader.readDepth(keyframe.id);
  }
  return store;
}

}  // namespace oikos::mapping
