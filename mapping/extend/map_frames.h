// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "mapping/extend/earlier_map.h"
#include "mapping/extend/gone_space.h"

namespace oikos::mapping {

/// The frames that a map is made of, numbered through: first those of earlier drives, of which the keyframes are left, then the
/// recording's. Without an earlier map the numbers and stamps are the recording's own.
class MapFrames {
 public:
  /// Both outlive this; `earlier` may be null.
  MapFrames(const recording::Recording& recording, const EarlierMap* earlier);

  /// A frame of the recording with its number and stamp in the map.
  [[nodiscard]] camera::RgbdFrame renumbered(camera::RgbdFrame frame) const;
  /// By its number in the map; of an earlier one, a keyframe. Thread-safe.
  [[nodiscard]] camera::RgbdFrame read(int frame, recording::Channels channels) const;
  /// The wheels' path, by the map's stamps.
  [[nodiscard]] std::optional<recording::Trajectory> findOdometry() const;

  [[nodiscard]] int firstOfDrive() const { return first_; }
  [[nodiscard]] std::int64_t addedToStampsS() const { return added_to_stamps_s_; }

  /// From now on, earlier frames have no readings of what has gone. Not while frames are read.
  void forget(GoneSpace gone, std::vector<Eigen::Isometry3d> T_map_keyframe);

 private:
  [[nodiscard]] camera::RgbdFrame readEarlier(int frame, recording::Channels channels) const;

  const recording::Recording& recording_;
  const EarlierMap* earlier_;
  int first_ = 0;
  std::int64_t added_to_stamps_s_ = 0;
  GoneSpace gone_;
  std::vector<Eigen::Isometry3d> T_map_keyframe_;
};

}  // namespace oikos::mapping
