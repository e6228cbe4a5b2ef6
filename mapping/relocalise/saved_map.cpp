// SPDX-License-Identifier: Apache-2.0
#include "mapping/relocalise/saved_map.h"

#include <utility>

#include "core/base/error.h"

namespace oikos::mapping {

SavedMap::SavedMap(const std::filesystem::path& file, const SavedMapConfig& config) : reader_(file) {
  for (StoredKeyframe& keyframe : reader_.readKeyframes()) {
    const int node_id = static_cast<int>(graph_.nodes.size());
    Node node;
    node.frame = keyframe.frame;
    node.stamp_ns = keyframe.stamp_ns;
    node.T_world_camera = keyframe.T_map_camera;
    for (Landmark& landmark : keyframe.landmarks) {
      landmark.host = node_id;
      node.hosted.push_back(static_cast<int>(graph_.landmarks.size()));
      graph_.landmarks.push_back(landmark);
    }
    graph_.nodes.push_back(std::move(node));
    places_.add(node_id, keyframe.features);
    features_.push_back(std::move(keyframe.features));
    stored_id_.push_back(keyframe.id);
  }
  if (graph_.nodes.empty()) {
    throw base::Error(base::ErrorCode::kInput, "no keyframe in it: map the home again", file.string());
  }
  images_ = std::make_unique<KeyframeImages>([this](int node) { return reader_.readGray(stored_id_[static_cast<std::size_t>(node)]); },
                                             config.pyramid_levels, config.images_in_memory);
}

}  // namespace oikos::mapping
