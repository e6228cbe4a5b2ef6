// SPDX-License-Identifier: Apache-2.0
// Which pieces a frame sees, and how much of each.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "registration/landmark/landmark_scene.h"
#include "semantic/model/home.h"
#include "tracking/localisation/localiser.h"
#include "tracking/state/articulated_pieces.h"
#include "tracking/state/state_config.h"

namespace oikos::tracking {

/// One piece in one frame.
struct PieceSight {
  int piece = 0;
  int pixels = 0;      ///< readings of it in the thinned image, if it is as it is believed
  double worth = 0.0;  ///< for a registration: the more pixels, and the more of its corners, the better
};

/// A located frame without its images.
struct SeenFrame {
  int frame = -1;  ///< of the recording
  std::int64_t stamp_ns = 0;
  PoseSource source = PoseSource::kNone;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
  std::vector<PieceSight> sights;  ///< ascending
};

/// Renders the home as it is believed, walls included, and counts. Not thread-safe.
class PieceViews {
 public:
  /// `pieces` are those of this home. Throws Error for a model that cannot be made.
  PieceViews(const semantic::Home& home, const std::filesystem::path& home_folder, const std::vector<ArticulatedPiece>& pieces,
             const FrameChoiceConfig& config);

  /// `pose`: of a frame that was found.
  [[nodiscard]] SeenFrame look(const camera::RgbdFrame& frame, const camera::PinholeCamera& camera, const LocatedPose& pose) const;

 private:
  const std::vector<ArticulatedPiece>& pieces_;
  FrameChoiceConfig config_;
  registration::LandmarkScene furniture_;
  std::vector<int> piece_of_landmark_;  ///< -1: none of them
};

}  // namespace oikos::tracking
