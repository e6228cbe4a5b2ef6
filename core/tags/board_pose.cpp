// SPDX-License-Identifier: Apache-2.0
#include "core/tags/board_pose.h"

#include <cmath>
#include <opencv2/calib3d.hpp>

#include "core/geometry/se3.h"

namespace oikos::tags {

namespace {

/// Corners on the board and in the picture, one beside the other.
struct CornerPairs {
  std::vector<cv::Point3d> board_m;
  std::vector<cv::Point2d> picture_px;
};

CornerPairs pairCorners(const TagBoard& board, const std::vector<TagDetection>& detections) {
  CornerPairs pairs;
  for (const TagDetection& detection : detections) {
    const auto corners_board = board.findCorners(detection.id);
    for (std::size_t i = 0; corners_board && i < corners_board->size(); ++i) {
      const Eigen::Vector3d& corner = (*corners_board)[i];
      pairs.board_m.emplace_back(corner.x(), corner.y(), corner.z());
      pairs.picture_px.emplace_back(detection.corners_px[i].x(), detection.corners_px[i].y());
    }
  }
  return pairs;
}

Eigen::Isometry3d toIsometry(const cv::Vec3d& rotation_rad, const cv::Vec3d& translation_m) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = geometry::expSo3({rotation_rad[0], rotation_rad[1], rotation_rad[2]});
  T.translation() = Eigen::Vector3d(translation_m[0], translation_m[1], translation_m[2]);
  return T;
}

}  // namespace

std::optional<BoardPose> estimateBoardPose(const TagBoard& board, const std::vector<TagDetection>& detections, const BoardCamera& camera) {
  const CornerPairs pairs = pairCorners(board, detections);
  if (pairs.board_m.empty()) {
    return std::nullopt;
  }
  const camera::PinholeCamera& pinhole = camera.pinhole;
  const cv::Matx33d K(pinhole.fx, 0.0, pinhole.cx, 0.0, pinhole.fy, pinhole.cy, 0.0, 0.0, 1.0);
  const camera::LensDistortion& d = camera.distortion;
  const cv::Vec<double, 5> distortion(d.k1, d.k2, d.p1, d.p2, d.k3);
  std::vector<cv::Vec3d> rotations;
  std::vector<cv::Vec3d> translations;
  if (cv::solvePnPGeneric(pairs.board_m, pairs.picture_px, K, distortion, rotations, translations, false, cv::SOLVEPNP_IPPE) == 0) {
    return std::nullopt;
  }
  cv::Vec3d rotation = rotations.front();  // the one with the smaller error
  cv::Vec3d translation = translations.front();
  cv::solvePnPRefineLM(pairs.board_m, pairs.picture_px, K, distortion, rotation, translation);
  std::vector<cv::Point2d> projected_px;
  cv::projectPoints(pairs.board_m, rotation, translation, K, distortion, projected_px);
  double sum_px_sq = 0.0;
  for (std::size_t i = 0; i < projected_px.size(); ++i) {
    sum_px_sq += (projected_px[i] - pairs.picture_px[i]).dot(projected_px[i] - pairs.picture_px[i]);
  }
  BoardPose pose{toIsometry(rotation, translation), static_cast<int>(projected_px.size()),
                 std::sqrt(sum_px_sq / static_cast<double>(projected_px.size()))};
  const bool is_good = pose.T_camera_board.matrix().allFinite() && std::isfinite(pose.rms_px) && translation[2] > 0.0;
  return is_good ? std::optional(pose) : std::nullopt;
}

}  // namespace oikos::tags
