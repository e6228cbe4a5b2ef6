// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "mapping/graph/keyframe_graph.h"
#include "mapping/odometry/features.h"

struct sqlite3;

namespace oikos::mapping {

/// A keyframe as it is kept for later: where it is, what it saw, and the landmarks that it hosts.
struct StoredKeyframe {
  int id = -1;     ///< node of the graph
  int frame = -1;  ///< position in the recording
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  cv::Mat color;    ///< CV_8UC3, BGR; kept as JPEG
  cv::Mat depth_m;  ///< CV_32FC1, NaN = no reading; kept to 0.2 mm, up to 13 m
  Features features;
  std::vector<Landmark> landmarks;
};

/// A keyframe's pictures as they are stored.
struct EncodedPictures {
  std::vector<unsigned char> color_jpeg;
  std::vector<unsigned char> depth_png;
};
/// The part of storing that takes time. Thread-safe.
[[nodiscard]] EncodedPictures encodePictures(const cv::Mat& color, const cv::Mat& depth_m);
/// The depth's part alone: what was read from a store comes out as the same readings.
[[nodiscard]] std::vector<unsigned char> encodeDepth(const cv::Mat& depth_m);

/// Writes `keyframes.sqlite`: tables `meta` (format, version, camera) and `keyframe` (one row each; blobs little-endian), in one ordered
/// transaction. The same calls give the same bytes. Not thread-safe. Throws Error{kIo}.
class KeyframeStoreWriter {
 public:
  KeyframeStoreWriter(const std::filesystem::path& file, const camera::PinholeCamera& camera);
  ~KeyframeStoreWriter();
  KeyframeStoreWriter(const KeyframeStoreWriter&) = delete;
  KeyframeStoreWriter& operator=(const KeyframeStoreWriter&) = delete;

  /// `keyframe.color` and `depth_m` are not looked at.
  void add(const StoredKeyframe& keyframe, const EncodedPictures& pictures);
  void commit();

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace oikos::mapping
