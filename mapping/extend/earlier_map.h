// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/recording/trajectory.h"
#include "mapping/extend/earlier_drives.h"
#include "mapping/graph/front_end.h"
#include "mapping/relocalise/saved_map.h"

namespace oikos::mapping {

/// A map as it was saved, opened to be extended by another drive. Everything is in `map`. Reading pictures is thread-safe.
class EarlierMap {
 public:
  /// `folder`: the `map` of a home. Throws Error: kUsage if there is none, kInput for what is wrong in it, or if its files are not of one
  /// map, kIo.
  EarlierMap(const std::filesystem::path& folder, const SavedMapConfig& config);

  /// Node n is keyframe n of all that follows.
  [[nodiscard]] const SavedMap& keyframes() const { return keyframes_; }
  /// What the front end goes on with: all nodes settled, the edges between them, features, no frames.
  [[nodiscard]] FrontEndResult start() const;
  /// `T_map_camera` of every frame of the earlier drives, in the order of the drives.
  [[nodiscard]] const recording::Trajectory& trajectory() const { return trajectory_; }
  /// `T_map_base` of those frames whose mount was known, by the same stamps.
  [[nodiscard]] const recording::Trajectory& baseTrajectory() const { return base_trajectory_; }
  [[nodiscard]] int frameCount() const { return static_cast<int>(trajectory_.size()); }
  [[nodiscard]] const std::vector<DriveFacts>& drives() const { return drives_.drives; }
  [[nodiscard]] bool isFloorFound() const { return drives_.is_floor_found; }
  /// The node whose frame this is.
  [[nodiscard]] std::optional<int> findKeyframe(int frame) const;

 private:
  void readEdges(const std::filesystem::path& file);
  void checkFrames(const std::filesystem::path& file) const;
  [[nodiscard]] std::vector<geometry::Vector6d> velocities() const;

  SavedMap keyframes_;
  std::vector<Edge> edges_;
  recording::Trajectory trajectory_;
  recording::Trajectory base_trajectory_;
  EarlierDrives drives_;
};

}  // namespace oikos::mapping
