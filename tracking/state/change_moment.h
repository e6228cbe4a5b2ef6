// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "registration/articulated/joint_fusion.h"
#include "tracking/state/joint_changes.h"
#include "tracking/state/state_reader.h"

namespace oikos::tracking {

/// An image of a recording.
struct ImageTime {
  std::int64_t stamp_ns = 0;
  int frame = 0;
};

/// When a door or drawer was moved: it left its place between two images. The second is the moment that is told; of one that is moved in
/// view of the camera it may still be on its way in that.
struct ChangeMoment {
  ImageTime first_after;                 ///< the first image that shows it no longer where it was,
  std::optional<ImageTime> last_before;  ///< and the last one that shows it still there; nothing: none does
};

/// All images between the two stays are heard, those too that have not found the joint. `change`: one of the reading's.
[[nodiscard]] ChangeMoment momentOf(const JointChange& change, const JointReading& reading, const registration::JointFusionConfig& config);

}  // namespace oikos::tracking
