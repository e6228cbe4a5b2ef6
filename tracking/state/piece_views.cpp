// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/piece_views.h"

#include <opencv2/core.hpp>

namespace oikos::tracking {

namespace {

constexpr double kAround_m = 0.03;  // beside a piece: errors of pose and depth
constexpr double kFloor_m = 0.04;   // lower readings are of the floor

std::vector<Eigen::Vector3d> readingsOf(const camera::RgbdFrame& frame, const camera::PinholeCamera& camera,
                                        const Eigen::Isometry3d& T_map_camera, const FrameChoiceConfig& config) {
  std::vector<Eigen::Vector3d> points_map;
  for (int v = 0; v < frame.depth_m.rows; v += config.step_px) {
    for (int u = 0; u < frame.depth_m.cols; u += config.step_px) {
      const auto depth_m = static_cast<double>(frame.depth_m.at<float>(v, u));
      if (depth_m > 0.0 && depth_m <= config.max_range_m) {
        const Eigen::Vector3d point_map = T_map_camera * (depth_m * camera.ray(u, v));
        if (point_map.z() > kFloor_m) {
          points_map.push_back(point_map);
        }
      }
    }
  }
  return points_map;
}

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(kAround_m);
  return {box.min() - around, box.max() + around};
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

SeenFrame lookFor(const std::vector<ArticulatedPiece>& pieces, const camera::RgbdFrame& frame, const camera::PinholeCamera& camera,
                  const LocatedPose& pose, const FrameChoiceConfig& config) {
  SeenFrame seen{frame.index, frame.stamp_ns, pose.source, pose.T_map_camera, pose.covariance, {}};
  const std::vector<Eigen::Vector3d> points_map = readingsOf(frame, camera, pose.T_map_camera, config);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Eigen::AlignedBox3d box = grown(pieces[p].box_model);
    const Eigen::AlignedBox3d reach = grown(pieces[p].reach_model);
    const Eigen::Isometry3d T_model_map = pieces[p].believed.T_map_model.inverse();
    int within = 0;
    int in_reach = 0;
    for (const Eigen::Vector3d& point_map : points_map) {
      const Eigen::Vector3d point_model = T_model_map * point_map;
      if (reach.contains(point_model)) {
        (box.contains(point_model) ? within : in_reach) += 1;
      }
    }
    if (within + in_reach >= config.min_pixels) {
      const double whole = shareInPicture(pieces[p], pose.T_map_camera, camera);
      const double weight = 1.0 - config.whole_weight + config.whole_weight * whole;
      seen.sights.push_back({static_cast<int>(p), weight * (within + config.reach_weight * in_reach)});
    }
  }
  return seen;
}

}  // namespace oikos::tracking
