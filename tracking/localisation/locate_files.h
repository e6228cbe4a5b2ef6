// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tracking/localisation/localiser.h"

namespace oikos::tracking {

/// What `oikos locate` leaves: FILE with the poses found (TUM format, `T_map_camera`), and beside it, named after it without its extension:
///   NAME.csv            every frame: stamp, source, status in the map, status of the refinement, pose, 6x6 covariance
///   NAME.base.txt      TUM: `T_map_base` of the poses found; only if the mount is known (S219)
///   NAME.before.txt     TUM: the poses that the landmarks refined; only if there was furniture
///   NAME.landmarks.csv  a line a piece in view of each frame: verdict, pixels, weight, contradiction, dropped parts; likewise
/// Each is written atomically. Throws Error{kIo}.
void writeLocated(const std::vector<LocatedPose>& poses, const std::optional<Eigen::Isometry3d>& T_base_camera,
                  const std::filesystem::path& file);

/// FILE's companion: `dir/name.txt` with ".csv" gives `dir/name.csv`.
[[nodiscard]] std::filesystem::path besideLocated(const std::filesystem::path& file, const char* ending);

}  // namespace oikos::tracking
