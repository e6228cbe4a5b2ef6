// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/map_frames.h"

#include <utility>

#include "core/base/error.h"

namespace oikos::mapping {

namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

/// Whole seconds that bring the drive behind the earlier ones, where its clock does not: many begin at zero.
std::int64_t secondsToAdd(std::int64_t first_ns, std::int64_t last_earlier_ns) {
  return first_ns > last_earlier_ns ? 0 : (last_earlier_ns - first_ns) / kNsPerS + 1;
}

}  // namespace

MapFrames::MapFrames(const recording::Recording& recording, const EarlierMap* earlier) : recording_(recording), earlier_(earlier) {
  if (earlier == nullptr) {
    return;
  }
  first_ = earlier->frameCount();
  std::int64_t last_ns = earlier->trajectory().front().stamp_ns;
  for (const recording::StampedPose& pose : earlier->trajectory()) {
    last_ns = std::max(last_ns, pose.stamp_ns);
  }
  added_to_stamps_s_ = recording.frameCount() > 0 ? secondsToAdd(recording.stampNs(0), last_ns) : 0;
}

camera::RgbdFrame MapFrames::renumbered(camera::RgbdFrame frame) const {
  frame.index += first_;
  frame.stamp_ns += added_to_stamps_s_ * kNsPerS;
  return frame;
}

camera::RgbdFrame MapFrames::read(int frame, recording::Channels channels) const {
  return frame < first_ ? readEarlier(frame, channels) : renumbered(recording_.read(frame - first_, channels));
}

camera::RgbdFrame MapFrames::readEarlier(int frame, recording::Channels channels) const {
  const auto node = earlier_->findKeyframe(frame);
  OIKOS_CHECK(node.has_value());
  const SavedMap& keyframes = earlier_->keyframes();
  camera::RgbdFrame read;
  read.index = frame;
  read.stamp_ns = keyframes.graph().nodes[static_cast<std::size_t>(*node)].stamp_ns;
  if (channels == recording::Channels::kColor) {
    read.color = keyframes.readColor(*node);
  } else {
    read.gray = keyframes.readGray(*node);
  }
  read.depth_m = keyframes.readDepth(*node);
  if (!gone_.empty()) {
    gone_.eraseFrom(read.depth_m, keyframes.camera(), T_map_keyframe_[static_cast<std::size_t>(*node)]);
  }
  return read;
}

std::optional<recording::Trajectory> MapFrames::findOdometry() const {
  std::optional<recording::Trajectory> odometry = recording_.findOdometry();
  if (odometry) {
    for (recording::StampedPose& pose : *odometry) {
      pose.stamp_ns += added_to_stamps_s_ * kNsPerS;
    }
  }
  return odometry;
}

void MapFrames::forget(GoneSpace gone, std::vector<Eigen::Isometry3d> T_map_keyframe) {
  gone_ = std::move(gone);
  T_map_keyframe_ = std::move(T_map_keyframe);
}

}  // namespace oikos::mapping
