// SPDX-License-Identifier: Apache-2.0
#include "tests/mapping/relocalise/saved_room.h"

#include <opencv2/core.hpp>

#include "mapping/graph/keyframe_reader.h"
#include "mapping/graph/keyframe_store.h"
#include "tests/mapping/graph/synthetic_drive.h"

namespace oikos::mapping {

test::SyntheticRecording recordingOf(const std::vector<Eigen::Isometry3d>& drive, const std::set<int>& blank_frames, std::uint64_t seed) {
  test::SyntheticSensor sensor;
  sensor.gray_sigma = 2.0;
  sensor.depth_sigma_scale = 1.0;
  sensor.blank_frames = blank_frames;
  sensor.seed = seed;
  return {test::TexturedWorld::furnished(), test::texturedCamera(), drive, sensor};
}

namespace {

constexpr double kFrameDeg = 4.0;

}  // namespace

SavedRoom::SavedRoom() {
  const auto recording = recordingOf(turnAround(0.0, 180.0, static_cast<int>(180.0 / kFrameDeg)));
  const DriveRun run(recording);
  const recording::Trajectory truth = recording.truth();
  KeyframeStoreWriter writer(file(), recording.camera());
  for (std::size_t n = 0; n < run.drive.graph.nodes.size(); ++n) {
    const Node& node = run.drive.graph.nodes[n];
    if (!node.keyframe) {
      continue;
    }
    StoredKeyframe stored{
        static_cast<int>(n),   node.frame, node.stamp_ns, truth[static_cast<std::size_t>(node.frame)].T_map_camera, {}, {},
        run.drive.features[n], {}};
    for (const int landmark : node.hosted) {
      stored.landmarks.push_back(run.drive.graph.landmarks[static_cast<std::size_t>(landmark)]);
    }
    const camera::RgbdFrame frame = recording.read(node.frame, recording::Channels::kColor);
    writer.add(stored, encodePictures(frame.color, frame.depth_m));
    ++keyframes;
  }
  writer.commit();
}

const SavedRoom& savedRoom() {
  static const SavedRoom room;
  return room;
}

}  // namespace oikos::mapping
