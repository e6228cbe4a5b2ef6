// SPDX-License-Identifier: Apache-2.0
// From what images say of a small object's place to whether it has gone: a hypothesis test, so that noise is no event.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "registration/scan.h"
#include "semantic/model/home.h"
#include "tracking/objects/object_config.h"
#include "tracking/objects/object_sight.h"

namespace oikos::tracking {

/// One image's word on one object.
struct TimedSight {
  int frame = 0;  ///< of the recording
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d camera_map = Eigen::Vector3d::Zero();  ///< where the image was taken
  ObjectSight sight;
};

enum class WatchStatus {
  kUnclear,  ///< no image can tell, or they do not agree, or too few say that it is not there
  kHidden,   ///< something stood before it in all images that could have told
  kThere,    ///< something is in its place
  kMissed,   ///< it has been looked for in plain view and is not there
};
constexpr auto enumTable(WatchStatus) {
  return std::to_array<base::EnumName<WatchStatus>>({{WatchStatus::kUnclear, "unclear"},
                                                     {WatchStatus::kHidden, "hidden"},
                                                     {WatchStatus::kThere, "there"},
                                                     {WatchStatus::kMissed, "missed"}});
}

/// What a recording says of a small object.
struct ObjectReading {
  semantic::ObjectId id;
  semantic::Placement placement;  ///< where it was looked for
  WatchStatus status = WatchStatus::kUnclear;
  int views = 0;                ///< images that were looked at; of these:
  int there = 0;                ///< that have something in its place,
  int not_there = 0;            ///< that look through it,
  int hidden = 0;               ///< and that have something before it
  double confidence = 0.0;      ///< of a miss: that it would have been seen, had it been there
  std::int64_t stamp_ns = 0;    ///< of the first image that is sure to miss it,
  int frame = 0;                ///< that image,
  int evidence_frame = 0;       ///< the one that shows its empty place best,
  registration::PixelBox crop;  ///< and where that is in it
};

/// `sights`: in the order of time. Images that look through its place count from the last one on that had something there, each by its word
/// against the object. At least `min_views` of them must have been taken from `apart_m` apart, since others repeat each other, and one
/// must be sure by itself; the chance that all are wrong is `misread` to the power of the sum of their words. `id` and `placement` are left
/// to the caller.
[[nodiscard]] ObjectReading testMissed(const std::vector<TimedSight>& sights, double apart_m, const MissedTestConfig& config);

}  // namespace oikos::tracking
