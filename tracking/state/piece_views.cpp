// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/piece_views.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "tracking/localisation/home_landmarks.h"

namespace oikos::tracking {

namespace {

/// Points only: to count, no normals are needed.
registration::Scan pointsOf(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const FrameChoiceConfig& config) {
  registration::Scan scan;
  scan.camera = registration::thinned(camera, config.step_px);
  scan.points.resize(static_cast<std::size_t>(scan.camera.width) * static_cast<std::size_t>(scan.camera.height));
  std::size_t i = 0;
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u, ++i) {
      const float z = depth_m.at<float>(v * config.step_px, u * config.step_px);
      if (z > 0.0F && z <= static_cast<float>(config.max_range_m)) {
        scan.points[i].point_camera.z() = z;
      }
    }
  }
  return scan;
}

/// Of a box's corners, those in the picture.
double shareInPicture(const ArticulatedPiece& piece, const Eigen::Isometry3d& T_map_camera, const camera::PinholeCamera& camera) {
  const Eigen::Isometry3d T_camera_model = T_map_camera.inverse() * piece.believed.T_map_model;
  int inside = 0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = T_camera_model * piece.box_model.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    inside += corner.z() > 0.1 && camera.contains(camera.project(corner)) ? 1 : 0;
  }
  return inside / 8.0;
}

}  // namespace

PieceViews::PieceViews(const semantic::Home& home, const std::filesystem::path& home_folder, const std::vector<ArticulatedPiece>& pieces,
                       const FrameChoiceConfig& config)
    : pieces_(pieces), config_(config), furniture_(makeLandmarks(home, home_folder, {.has_shiftable = true})) {
  for (const std::string& id : furniture_.ids()) {
    const auto found = std::find_if(pieces.begin(), pieces.end(), [&](const ArticulatedPiece& piece) { return piece.id.value == id; });
    piece_of_landmark_.push_back(found == pieces.end() ? -1 : static_cast<int>(found - pieces.begin()));
  }
}

SeenFrame PieceViews::look(const camera::RgbdFrame& frame, const camera::PinholeCamera& camera, const LocatedPose& pose) const {
  SeenFrame seen{frame.index, frame.stamp_ns, pose.source, pose.T_map_camera, pose.covariance, {}};
  const std::vector<int> pixels = furniture_.countInView(pointsOf(frame.depth_m, camera, config_), pose.T_map_camera, 1);
  std::vector<int> of_piece(pieces_.size(), 0);
  for (std::size_t s = 0; s < pixels.size(); ++s) {
    const int piece = piece_of_landmark_[static_cast<std::size_t>(furniture_.surfaces()[s].landmark)];
    if (piece >= 0) {
      of_piece[static_cast<std::size_t>(piece)] += pixels[s];
    }
  }
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    if (of_piece[p] >= config_.min_pixels) {
      const double whole = shareInPicture(pieces_[p], pose.T_map_camera, camera);
      const double weight = 1.0 - config_.middle_weight + config_.middle_weight * whole;
      seen.sights.push_back({static_cast<int>(p), of_piece[p], weight * of_piece[p]});
    }
  }
  return seen;
}

}  // namespace oikos::tracking
