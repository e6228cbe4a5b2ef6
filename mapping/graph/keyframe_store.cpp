// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/keyframe_store.h"

#include <sqlite3.h>

#include <cmath>
#include <cstring>

#include "core/base/error.h"
#include "core/recording/image_codec.h"
#include "core/recording/png_encoder.h"
#include "mapping/graph/keyframe_rows.h"
#include "mapping/graph/sqlite_statement.h"

namespace oikos::mapping {

namespace {

constexpr int kJpegQuality = 92;
/// Pictures come last: who reads the rest does not have to walk through them.
constexpr const char* kSchema =
    "CREATE TABLE meta(key TEXT PRIMARY KEY, value) WITHOUT ROWID;"
    "CREATE TABLE keyframe(id INTEGER PRIMARY KEY, frame INTEGER NOT NULL, stamp_ns INTEGER NOT NULL, t_map_camera BLOB NOT NULL,"
    " features BLOB NOT NULL, landmarks BLOB NOT NULL, color_jpeg BLOB NOT NULL, depth_png BLOB NOT NULL);";

template <class Row>
std::vector<unsigned char> toBlob(const std::vector<Row>& rows) {
  std::vector<unsigned char> blob(rows.size() * sizeof(Row));
  if (!blob.empty()) {
    std::memcpy(blob.data(), rows.data(), blob.size());
  }
  return blob;
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

void putMeta(sqlite3* database, const std::filesystem::path& file, const char* key, auto value) {
  Statement insert(database, "INSERT INTO meta VALUES(?, ?)", file.string());
  insert.bind(1, key);
  insert.bind(2, value);
  insert.step();
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

EncodedPictures encodePictures(const cv::Mat& color, const cv::Mat& depth_m) {
  return {recording::encodeJpeg(color, kJpegQuality), encodeDepth(depth_m)};
}

void KeyframeStoreWriter::add(const StoredKeyframe& keyframe, const EncodedPictures& pictures) {
  Statement insert(database_.get(), "INSERT INTO keyframe VALUES(?, ?, ?, ?, ?, ?, ?, ?)", file_.string());
  insert.bind(1, std::int64_t{keyframe.id});
  insert.bind(2, std::int64_t{keyframe.frame});
  insert.bind(3, keyframe.stamp_ns);
  insert.bind(4, encodePose(keyframe.T_map_camera));
  insert.bind(5, encodeFeatures(keyframe.features));
  insert.bind(6, encodeLandmarks(keyframe.landmarks));
  insert.bind(7, pictures.color_jpeg);
  insert.bind(8, pictures.depth_png);
  insert.step();
}

void KeyframeStoreWriter::commit() {
  execute(database_.get(), "COMMIT;", file_);
}

}  // namespace oikos::mapping
