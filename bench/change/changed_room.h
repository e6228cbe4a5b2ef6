// SPDX-License-Identifier: Apache-2.0
// Random rooms of boxes before and after something was changed, as a Kinect records them.
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "mapping/change/change_finder.h"
#include "mapping/change/seen_space.h"

namespace oikos::bench {

using BoxM = Eigen::AlignedBox3d;  ///< in map

/// A room of 6 m × 5 m × 2.5 m, its origin in the middle of the floor; furniture keeps clear of a disc of 1.1 m in the middle.
struct Room {
  std::vector<BoxM> furniture;
};

enum class EventKind { kAdded, kRemoved, kMoved };

/// Something done to a piece; `before` or `after` is empty where there is none.
struct RoomEvent {
  EventKind kind = EventKind::kAdded;
  BoxM before;
  BoxM after;
};

struct ChangedRoom {
  Room room;
  std::vector<RoomEvent> events;
};

[[nodiscard]] Room randomRoom(int pieces, std::mt19937_64& random);
/// Each piece is changed once at most.
[[nodiscard]] ChangedRoom changeRoom(const Room& room, int events, std::mt19937_64& random);

/// Errors of poses: root mean square of the whole vector, in no preferred direction.
struct PoseNoise {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

/// `ring` views out of the middle and `wanderer` views from anywhere; poses as they are believed.
struct DriveSize {
  int ring = 0;
  int wanderer = 0;
};
[[nodiscard]] std::vector<mapping::LocatedScan> drive(const Room& room, const DriveSize& size, const PoseNoise& noise,
                                                      std::mt19937_64& random);

}  // namespace oikos::bench
