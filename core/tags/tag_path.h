// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/progress.h"
#include "core/recording/trajectory.h"

namespace oikos::tags {

struct TagPathConfig {
  double max_distance_m = 6.0;  ///< from the camera to the board's middle
  double max_rms_px = 1.5;      ///< of the corners about the pose: more is no board of this shape
  int threads = 1;

  [[nodiscard]] std::vector<std::string> validate() const;
};

/// What became of a picture.
enum class TagPictureStatus {
  kTagsMissing,  ///< not all tags of the board were found
  kBadFit,       ///< they lie otherwise than on the board
  kTooFar,
  kKept,
};
constexpr auto enumTable(TagPictureStatus) {
  return std::to_array<base::EnumName<TagPictureStatus>>({{TagPictureStatus::kTagsMissing, "tags-missing"},
                                                          {TagPictureStatus::kBadFit, "bad-fit"},
                                                          {TagPictureStatus::kTooFar, "too-far"},
                                                          {TagPictureStatus::kKept, "kept"}});
}

struct TagPicture {
  TagPictureStatus status = TagPictureStatus::kTagsMissing;
  std::int64_t stamp_ns = 0;
  int tags = 0;             ///< of the board that were found
  double distance_m = 0.0;  ///< kTooFar and kKept
  double rms_px = 0.0;      ///< all but kTagsMissing
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();
};

/// The robot's path by a camera that hangs still and sees a board of tags on the robot, as in the papers: a picture counts only if all
/// patterns are found and the board is at most 6 m away. `folder` holds `rgb.txt` with its pictures, `camera.toml` and `tags.toml`.
/// In the pictures' order; the same for any number of threads. Throws Error.
[[nodiscard]] std::vector<TagPicture> readTagPath(const std::filesystem::path& folder, const TagPathConfig& config,
                                                  const base::ProgressSink& progress = {});

/// T_map_base of the pictures that are kept.
[[nodiscard]] recording::Trajectory keptPath(const std::vector<TagPicture>& pictures);

}  // namespace oikos::tags
