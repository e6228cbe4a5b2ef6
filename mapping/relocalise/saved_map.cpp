// SPDX-License-Identifier: Apache-2.0
#include "mapping/relocalise/saved_map.h"

#include <cmath>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/base/number_text.h"

namespace oikos::mapping {

namespace {

std::string cameraText(const camera::PinholeCamera& camera) {
  using base::toText;
  return std::to_string(camera.width) + "x" + std::to_string(camera.height) + ", fx " + toText(camera.fx) + ", fy " + toText(camera.fy) +
         ", cx " + toText(camera.cx) + ", cy " + toText(camera.cy);
}

}  // namespace

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

void requireSameCamera(const camera::PinholeCamera& map, const camera::PinholeCamera& recording, const std::filesystem::path& file) {
  const auto near = [](double a, double b) { return std::abs(a - b) <= 0.5; };
  if (map.width != recording.width || map.height != recording.height || !near(map.fx, recording.fx) || !near(map.fy, recording.fy) ||
      !near(map.cx, recording.cx) || !near(map.cy, recording.cy)) {
    throw base::Error(base::ErrorCode::kInput,
                      "the map was made with another camera (" + cameraText(map) + ") than the recording's (" + cameraText(recording) +
                          "): map the home with this one",
                      file.string());
  }
}

}  // namespace oikos::mapping
