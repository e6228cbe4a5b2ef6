// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/graph/keyframe_store.h"

struct sqlite3;

namespace oikos::mapping {

/// Opens `keyframes.sqlite`; pictures are decoded when they are asked for. All methods throw Error{kInput} that names what is wrong: not a
/// store, a newer version, a damaged blob.
class KeyframeReader {
 public:
  explicit KeyframeReader(const std::filesystem::path& file);

  [[nodiscard]] const camera::PinholeCamera& camera() const { return camera_; }
  /// All of them, in order of their ids, without their pictures. Thread-safe.
  [[nodiscard]] std::vector<StoredKeyframe> readKeyframes() const;
  // Pictures of the keyframe with this id, which is there. Thread-safe.
  [[nodiscard]] cv::Mat readColor(int id) const;  ///< CV_8UC3, BGR
  [[nodiscard]] cv::Mat readGray(int id) const;   ///< CV_8UC1: the JPEG's brightness
  [[nodiscard]] cv::Mat readDepth(int id) const;  ///< CV_32FC1, metres, NaN = no reading
  /// As they are stored: to be stored again without loss.
  [[nodiscard]] EncodedPictures readPictures(int id) const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  [[nodiscard]] std::vector<unsigned char> readBlob(const char* select, int id) const;

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
  mutable std::mutex mutex_;
  camera::PinholeCamera camera_;
};

/// A whole store.
struct KeyframeStore {
  camera::PinholeCamera camera;
  std::vector<StoredKeyframe> keyframes;
};
[[nodiscard]] KeyframeStore readKeyframeStore(const std::filesystem::path& file);

}  // namespace oikos::mapping
