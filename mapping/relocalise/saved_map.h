// SPDX-License-Identifier: Apache-2.0
// What `oikos map` has left behind for finding oneself again.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/graph/keyframe_graph.h"
#include "mapping/graph/keyframe_images.h"
#include "mapping/graph/keyframe_reader.h"
#include "mapping/graph/place_index.h"
#include "mapping/odometry/features.h"

namespace oikos::mapping {

struct SavedMapConfig {
  int pyramid_levels = 5;     ///< those of the map
  int images_in_memory = 60;  ///< pyramids of keyframes kept; the others are read again
};

/// The keyframes of a map: poses, features and landmarks in memory, pictures from the disk when they are needed. The place index is built
/// anew. Everything is in `map`: a node's `T_world_camera` is `T_map_camera`. Thread-safe.
class SavedMap {
 public:
  /// `file`: a `keyframes.sqlite`. Throws Error{kInput} for what is wrong in it, and if there is no keyframe in it.
  explicit SavedMap(const std::filesystem::path& file, const SavedMapConfig& config = {});

  [[nodiscard]] const camera::PinholeCamera& camera() const { return reader_.camera(); }
  /// Nodes are the keyframes, numbered through; there are no edges.
  [[nodiscard]] const KeyframeGraph& graph() const { return graph_; }
  [[nodiscard]] int keyframeCount() const { return static_cast<int>(graph_.nodes.size()); }
  [[nodiscard]] const Features& features(int node) const { return features_[static_cast<std::size_t>(node)]; }
  /// By node.
  [[nodiscard]] const PlaceIndex& places() const { return places_; }
  [[nodiscard]] std::shared_ptr<const ImagePyramid> pyramid(int node) const { return images_->get(node); }
  // Of the node's keyframe, from the disk.
  [[nodiscard]] int storedId(int node) const { return stored_id_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] cv::Mat readColor(int node) const { return reader_.readColor(storedId(node)); }
  [[nodiscard]] cv::Mat readGray(int node) const { return reader_.readGray(storedId(node)); }
  [[nodiscard]] cv::Mat readDepth(int node) const { return reader_.readDepth(storedId(node)); }
  [[nodiscard]] EncodedPictures readPictures(int node) const { return reader_.readPictures(storedId(node)); }

 private:
  KeyframeReader reader_;
  KeyframeGraph graph_;
  std::vector<int> stored_id_;  ///< of each node
  std::vector<Features> features_;
  PlaceIndex places_;
  std::unique_ptr<KeyframeImages> images_;
};

/// Landmarks of one camera are not looked for with another: half a pixel is forgiven. Throws Error{kInput}; `file` is the map's.
void requireSameCamera(const camera::PinholeCamera& map, const camera::PinholeCamera& recording, const std::filesystem::path& file);

}  // namespace oikos::mapping
