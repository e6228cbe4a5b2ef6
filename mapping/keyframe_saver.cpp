// SPDX-License-Identifier: Apache-2.0
#include "mapping/keyframe_saver.h"

#include <cstddef>
#include <utility>

namespace oikos::mapping {

KeyframeSaver::KeyframeSaver(const std::filesystem::path& file, const camera::PinholeCamera& camera, const Sources& sources)
    : sources_(sources), camera_(camera), store_(file, camera) {
  const std::vector<Node>& nodes = sources.drive.graph.nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].keyframe) {
      node_of_frame_[nodes[n].frame] = static_cast<int>(n);
    }
  }
}

ViewObserver KeyframeSaver::observer() {
  return {[this](const camera::RgbdFrame& frame) { prepare(frame); }, [this](const camera::RgbdFrame& frame) { add(frame); }};
}

void KeyframeSaver::prepare(const camera::RgbdFrame& frame) {
  if (const auto node = node_of_frame_.find(frame.index); node != node_of_frame_.end()) {
    EncodedPictures encoded = picturesOf(node->second, frame);
    const std::lock_guard lock(mutex_);
    pictures_[frame.index] = std::move(encoded);
  }
}

void KeyframeSaver::add(const camera::RgbdFrame& frame) {
  if (const auto node = node_of_frame_.find(frame.index); node != node_of_frame_.end()) {
    EncodedPictures encoded;
    {
      const std::lock_guard lock(mutex_);
      encoded = std::move(pictures_.at(frame.index));
      pictures_.erase(frame.index);
    }
    store_.add(toStored(node->second), encoded);
  }
}

/// A picture that is compressed anew each time a map is extended would fade.
EncodedPictures KeyframeSaver::picturesOf(int node, const camera::RgbdFrame& frame) const {
  if (node >= sources_.drive.graph.settled) {
    return encodePictures(frame.color, frame.depth_m);
  }
  EncodedPictures pictures = sources_.earlier->keyframes().readPictures(node);
  if (!sources_.gone.empty()) {
    pictures.depth_png = encodeDepth(frame.depth_m);
  }
  return pictures;
}

StoredKeyframe KeyframeSaver::toStored(int id) const {
  const KeyframeGraph& graph = sources_.drive.graph;
  const Node& node = graph.nodes[static_cast<std::size_t>(id)];
  StoredKeyframe stored{id, node.frame, node.stamp_ns, node.T_world_camera, {}, {}, sources_.drive.features[static_cast<std::size_t>(id)],
                        {}};
  for (const int landmark : node.hosted) {
    stored.landmarks.push_back(graph.landmarks[static_cast<std::size_t>(landmark)]);
  }
  if (id < graph.settled && !sources_.gone.empty()) {
    dropGone(stored);
  }
  return stored;
}

/// Landmarks and features on what is no longer there would only lead astray.
void KeyframeSaver::dropGone(StoredKeyframe& keyframe) const {
  std::erase_if(keyframe.landmarks,
                [&](const Landmark& landmark) { return sources_.gone.contains(keyframe.T_map_camera * pointInHost(landmark, camera_)); });
  Features kept;
  for (std::size_t i = 0; i < keyframe.features.pixel.size(); ++i) {
    if (!sources_.gone.contains(keyframe.T_map_camera * keyframe.features.point_camera[i])) {
      kept.pixel.push_back(keyframe.features.pixel[i]);
      kept.point_camera.push_back(keyframe.features.point_camera[i]);
      kept.descriptor.push_back(keyframe.features.descriptor[i]);
    }
  }
  keyframe.features = std::move(kept);
}

}  // namespace oikos::mapping
