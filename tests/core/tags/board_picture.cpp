// SPDX-License-Identifier: Apache-2.0
#include "tests/core/tags/board_picture.h"

#include <cmath>

#include "core/geometry/tone_curve.h"
#include "core/render/camera_rays.h"
#include "core/tags/tag_family.h"

namespace oikos::tags {

namespace {

constexpr int kSamples = 6;  // along a pixel's side

/// Light where a ray meets the board, which `cells` shows with a pixel a cell.
double brightnessAt(const Eigen::Vector2d& ray, const Eigen::Isometry3d& T_board_camera, const TagBoard& board, const cv::Mat& cells) {
  constexpr double kWall = 0.3;
  const Eigen::Vector3d direction_board = T_board_camera.linear() * ray.homogeneous();
  const double along = -T_board_camera.translation().z() / direction_board.z();
  const Eigen::Vector3d point_board = T_board_camera.translation() + along * direction_board;
  const double cell_m = board.tag_size_m / kTagCells;
  const double column = std::floor((point_board.x() + 0.5 * board.width_m()) / cell_m);
  const double row = std::floor((0.5 * board.height_m() - point_board.y()) / cell_m);
  const bool is_on_board = along > 0.0 && column >= 0.0 && row >= 0.0 && column < cells.cols && row < cells.rows;
  return is_on_board ? cells.at<cv::Vec3b>(static_cast<int>(row), static_cast<int>(column))[0] / 255.0 : kWall;
}

}  // namespace

cv::Mat takeBoardPicture(const TagBoard& board, const BoardCamera& camera, const Eigen::Isometry3d& T_camera_board) {
  const render::CameraRays rays(camera.pinhole, camera.distortion);
  const cv::Mat cells = drawTagBoard(board, 1);
  const Eigen::Isometry3d T_board_camera = T_camera_board.inverse();
  const geometry::ToneCurve& curve = geometry::ToneCurve::instance();
  cv::Mat picture(camera.pinhole.height, camera.pinhole.width, CV_8UC1);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      double sum = 0.0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const Eigen::Vector2d offset_px((i % kSamples + 0.5) / kSamples - 0.5, (i / kSamples + 0.5) / kSamples - 0.5);
        sum += brightnessAt(rays.at(u, v, offset_px), T_board_camera, board, cells);
      }
      picture.at<std::uint8_t>(v, u) = curve.toByte(static_cast<float>(sum / (kSamples * kSamples)));
    }
  }
  return picture;
}

Eigen::Isometry3d placeBoard(const FacingBoard& board) {
  Eigen::Isometry3d T_camera_board = Eigen::Isometry3d::Identity();
  T_camera_board.linear() = Eigen::AngleAxisd(board.roll_rad, Eigen::Vector3d::UnitZ()) *
                            Eigen::AngleAxisd(board.tilt_rad, Eigen::Vector3d::UnitX()) * Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  T_camera_board.translation() = board.position_camera;
  return T_camera_board;
}

BoardCamera plainCamera() {
  return {{640, 480, 525.0, 525.0, 319.5, 239.5}, {}};
}

}  // namespace oikos::tags
