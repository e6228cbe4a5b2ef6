// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/object_readings.h"

#include "core/base/progress.h"

namespace oikos::tracking {

namespace {

WatchFrame watchFrameOf(const SeenFrame& seen) {
  return {seen.frame, seen.stamp_ns, seen.T_map_camera, seen.covariance, seen.source == PoseSource::kLandmarks};
}

}  // namespace

CarrierReadings carriersOf(const RecordingStates& states, const MovedFurnitureConfig& config) {
  CarrierReadings carriers{{}, states.furniture, config.min_moved_m, config.min_moved_deg};
  for (const PieceReading& piece : states.pieces) {
    PieceJoints joints{piece.id, 2 * piece.not_there > piece.images, {}};
    for (const JointReading& joint : piece.joints) {
      for (const JointStay& stay : joint.stays) {
        joints.spans[joint.id].push_back(stay.span);
      }
    }
    carriers.pieces.push_back(std::move(joints));
  }
  return carriers;
}

std::vector<ObjectReading> readObjects(const RecordingStates& states, const camera::PinholeCamera& camera, const StateTools& tools,
                                       const ReadFrame& read) {
  if (!tools.only.empty()) {
    return {};
  }
  std::vector<WatchFrame> frames;
  for (const SeenFrame& seen : tools.reader.frames()) {
    frames.push_back(watchFrameOf(seen));
  }
  ObjectWatch watch(tools.home, tools.home_folder, carriersOf(states, tools.config.furniture), frames, camera, tools.config.objects);
  for (std::vector<int> wanted = watch.wanted(); !wanted.empty(); wanted = watch.wanted()) {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const camera::RgbdFrame frame = read(wanted[i]);
      watch.look(frame, watchFrameOf(tools.reader.seen(wanted[i])));
      base::reportProgress(tools.progress, {"looking for small objects", static_cast<int>(i + 1), static_cast<int>(wanted.size())});
    }
  }
  return watch.conclude();
}

}  // namespace oikos::tracking
