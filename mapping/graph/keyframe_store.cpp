// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/keyframe_store.h"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/geometry/pose_numbers.h"
#include "core/recording/depth_png.h"
#include "core/recording/image_codec.h"
#include "core/recording/png_encoder.h"

namespace oikos::mapping {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr const char* kFormat = "oikos-keyframes";
constexpr int kVersion = 1;
constexpr double kDepthUnitsPerMetre = 5000.0;
constexpr int kJpegQuality = 92;
constexpr const char* kSchema =
    "CREATE TABLE meta(key TEXT PRIMARY KEY, value) WITHOUT ROWID;"
    "CREATE TABLE keyframe(id INTEGER PRIMARY KEY, frame INTEGER NOT NULL, stamp_ns INTEGER NOT NULL, t_map_camera BLOB NOT NULL,"
    " color_jpeg BLOB NOT NULL, depth_png BLOB NOT NULL, features BLOB NOT NULL, landmarks BLOB NOT NULL);";

/// One feature in the blob.
struct FeatureRow {
  double pixel[2];
  double point_camera[3];
  std::uint64_t descriptor[4];
};

struct LandmarkRow {
  double pixel[2];
  double inverse_depth;
  double sigma;
  double inverse_depth_gradient[2];
};

template <class Row>
std::vector<unsigned char> toBlob(const std::vector<Row>& rows) {
  std::vector<unsigned char> blob(rows.size() * sizeof(Row));
  if (!blob.empty()) {
    std::memcpy(blob.data(), rows.data(), blob.size());
  }
  return blob;
}

std::vector<unsigned char> encodeDepth(const cv::Mat& depth_m) {
  cv::Mat units(depth_m.size(), CV_16UC1);
  for (int y = 0; y < depth_m.rows; ++y) {
    const float* in = depth_m.ptr<float>(y);
    auto* out = units.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth_m.cols; ++x) {
      const double value = static_cast<double>(in[x]) * kDepthUnitsPerMetre;
      out[x] = value > 0.0 && value < 65535.0 ? static_cast<std::uint16_t>(std::lround(value)) : std::uint16_t{0};
    }
  }
  return recording::encodePng(units, 1);
}

std::vector<unsigned char> encodeFeatures(const Features& features) {
  std::vector<FeatureRow> rows(static_cast<std::size_t>(features.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Vector2d& px = features.pixel[i];
    const Eigen::Vector3d& p = features.point_camera[i];
    const Descriptor& d = features.descriptor[i];
    rows[i] = {{px.x(), px.y()}, {p.x(), p.y(), p.z()}, {d[0], d[1], d[2], d[3]}};
  }
  return toBlob(rows);
}

std::vector<unsigned char> encodeLandmarks(const std::vector<Landmark>& landmarks) {
  std::vector<LandmarkRow> rows;
  for (const Landmark& l : landmarks) {
    rows.push_back({{l.pixel.x(), l.pixel.y()}, l.inverse_depth, l.sigma, {l.inverse_depth_gradient.x(), l.inverse_depth_gradient.y()}});
  }
  return toBlob(rows);
}

std::vector<unsigned char> encodePose(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  return toBlob<double>({T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()});
}

/// A prepared statement with its database's error turned into ours.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql, std::string where) : database_(database), where_(std::move(where)) {
    check(sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr));
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(Statement&& other) noexcept
      : database_(other.database_), where_(std::move(other.where_)), statement_(std::exchange(other.statement_, nullptr)) {}
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int index, std::int64_t value) { check(sqlite3_bind_int64(statement_, index, value)); }
  void bind(int index, double value) { check(sqlite3_bind_double(statement_, index, value)); }
  void bind(int index, const char* text) { check(sqlite3_bind_text(statement_, index, text, -1, SQLITE_TRANSIENT)); }
  void bind(int index, const std::vector<unsigned char>& blob) {
    check(sqlite3_bind_blob64(statement_, index, blob.empty() ? reinterpret_cast<const unsigned char*>("") : blob.data(), blob.size(),
                              SQLITE_TRANSIENT));
  }
  /// True while there is a row.
  bool step() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) {
      check(code);
    }
    return code == SQLITE_ROW;
  }
  [[nodiscard]] std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  [[nodiscard]] double real(int column) const { return sqlite3_column_double(statement_, column); }
  [[nodiscard]] std::string text(int column) const {
    const auto* characters = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return characters == nullptr ? std::string() : std::string(characters);
  }
  [[nodiscard]] std::vector<unsigned char> blob(int column) const {
    const auto* begin = static_cast<const unsigned char*>(sqlite3_column_blob(statement_, column));
    const int size = sqlite3_column_bytes(statement_, column);
    return begin == nullptr ? std::vector<unsigned char>{} : std::vector<unsigned char>(begin, begin + size);
  }

 private:
  void check(int code) const {
    if (code != SQLITE_OK) {
      const bool damaged = code == SQLITE_NOTADB || code == SQLITE_CORRUPT || code == SQLITE_ERROR;
      throw base::Error(damaged ? base::ErrorCode::kInput : base::ErrorCode::kIo, sqlite3_errmsg(database_), where_);
    }
  }
  sqlite3* database_;
  std::string where_;
  sqlite3_stmt* statement_ = nullptr;
};

void execute(sqlite3* database, const char* sql, const std::filesystem::path& file) {
  if (sqlite3_exec(database, sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
    throw base::Error(base::ErrorCode::kIo, sqlite3_errmsg(database), file.string());
  }
}

void putMeta(sqlite3* database, const std::filesystem::path& file, const char* key, auto value) {
  Statement insert(database, "INSERT INTO meta VALUES(?, ?)", file.string());
  insert.bind(1, key);
  insert.bind(2, value);
  insert.step();
}

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

StoredKeyframe readRow(const Statement& row, const std::string& file) {
  StoredKeyframe k;
  k.id = static_cast<int>(row.integer(0));
  const std::string where = file + ": keyframe " + std::to_string(k.id);
  k.frame = static_cast<int>(row.integer(1));
  k.stamp_ns = row.integer(2);
  k.T_map_camera = decodePose(fromBlob<double>(row.blob(3), where), where);
  k.color = recording::decodeColorImage(textOf(row.blob(4)), where);
  k.depth_m = decodeDepth(row.blob(5), where);
  for (const FeatureRow& f : fromBlob<FeatureRow>(row.blob(6), where)) {
    k.features.pixel.emplace_back(f.pixel[0], f.pixel[1]);
    k.features.point_camera.emplace_back(f.point_camera[0], f.point_camera[1], f.point_camera[2]);
    k.features.descriptor.push_back({f.descriptor[0], f.descriptor[1], f.descriptor[2], f.descriptor[3]});
  }
  for (const LandmarkRow& l : fromBlob<LandmarkRow>(row.blob(7), where)) {
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

void KeyframeStoreWriter::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

KeyframeStoreWriter::KeyframeStoreWriter(const std::filesystem::path& file, const camera::PinholeCamera& camera) : file_(file) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) {
    throw base::Error(base::ErrorCode::kIo, sqlite3_errstr(code), file.string());
  }
  // The folder that holds the file is exchanged as a whole: no journal is needed, and none may be left behind.
  execute(opened, "PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; PRAGMA cache_size=-1024; BEGIN;", file_);
  execute(opened, kSchema, file_);
  putMeta(opened, file_, "format", kFormat);
  putMeta(opened, file_, "version", std::int64_t{kVersion});
  putMeta(opened, file_, "width_px", std::int64_t{camera.width});
  putMeta(opened, file_, "height_px", std::int64_t{camera.height});
  putMeta(opened, file_, "fx_px", camera.fx);
  putMeta(opened, file_, "fy_px", camera.fy);
  putMeta(opened, file_, "cx_px", camera.cx);
  putMeta(opened, file_, "cy_px", camera.cy);
  putMeta(opened, file_, "depth_units_per_m", kDepthUnitsPerMetre);
}

KeyframeStoreWriter::~KeyframeStoreWriter() = default;

EncodedPictures encodePictures(const cv::Mat& color, const cv::Mat& depth_m) {
  return {recording::encodeJpeg(color, kJpegQuality), encodeDepth(depth_m)};
}

void KeyframeStoreWriter::add(const StoredKeyframe& keyframe, const EncodedPictures& pictures) {
  Statement insert(database_.get(), "INSERT INTO keyframe VALUES(?, ?, ?, ?, ?, ?, ?, ?)", file_.string());
  insert.bind(1, std::int64_t{keyframe.id});
  insert.bind(2, std::int64_t{keyframe.frame});
  insert.bind(3, keyframe.stamp_ns);
  insert.bind(4, encodePose(keyframe.T_map_camera));
  insert.bind(5, pictures.color_jpeg);
  insert.bind(6, pictures.depth_png);
  insert.bind(7, encodeFeatures(keyframe.features));
  insert.bind(8, encodeLandmarks(keyframe.landmarks));
  insert.step();
}

void KeyframeStoreWriter::commit() {
  execute(database_.get(), "COMMIT;", file_);
}

KeyframeStore readKeyframeStore(const std::filesystem::path& file) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(opened, &sqlite3_close);
  if (code != SQLITE_OK) {
    throw base::Error(base::ErrorCode::kIo, sqlite3_errstr(code), file.string());
  }
  const std::string where = file.string();
  checkFormat(opened, where);
  KeyframeStore store;
  store.camera = {static_cast<int>(metaNumber(opened, where, "width_px")),
                  static_cast<int>(metaNumber(opened, where, "height_px")),
                  metaNumber(opened, where, "fx_px"),
                  metaNumber(opened, where, "fy_px"),
                  metaNumber(opened, where, "cx_px"),
                  metaNumber(opened, where, "cy_px")};
  Statement rows(opened, "SELECT id, frame, stamp_ns, t_map_camera, color_jpeg, depth_png, features, landmarks FROM keyframe ORDER BY id",
                 where);
  while (rows.step()) {
    store.keyframes.push_back(readRow(rows, where));
  }
  return store;
}

}  // namespace oikos::mapping
