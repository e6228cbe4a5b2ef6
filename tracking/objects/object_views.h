// SPDX-License-Identifier: Apache-2.0
// Which frames of a recording have an object's place in plain view, as far as can be told without their images.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/geometry/se3.h"
#include "tracking/objects/believed_scene.h"
#include "tracking/objects/object_config.h"

namespace oikos::tracking {

/// A frame that was located, without its images.
struct WatchFrame {
  int frame = 0;  ///< of the recording
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation (m, rad)
  bool was_read = false;                                       ///< for something else
};

/// A frame that should show an object as a whole, near and large enough, with nothing known before it.
struct ObjectCandidate {
  int frame = 0;  ///< of the recording
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d camera_map = Eigen::Vector3d::Zero();
  double worth = 0.0;  ///< pixels that should show the object; more than enough is not better
};

/// For each object of the scene, in the order of time. The scene goes to the times of the frames.
[[nodiscard]] std::vector<std::vector<ObjectCandidate>> findCandidates(BelievedScene& scene, const std::vector<WatchFrame>& frames,
                                                                       const camera::PinholeCamera& camera, const ObjectViewConfig& config);

/// The best candidate from `from_ns` on that was taken from apart of all these places; nothing: none is worth it. `read`: frames that are
/// read anyway.
[[nodiscard]] std::optional<ObjectCandidate> bestCandidate(const std::vector<ObjectCandidate>& candidates, std::int64_t from_ns,
                                                           const std::vector<Eigen::Vector3d>& places_map, const std::set<int>& read,
                                                           const ObjectViewConfig& config);

}  // namespace oikos::tracking
