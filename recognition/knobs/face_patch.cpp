// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/face_patch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace oikos::recognition {

namespace {

/// Maps (x, y, 1) of the patch's plane to homogeneous pixels of the picture.
Eigen::Matrix3d homographyOf(const FaceView& view, const camera::PinholeCamera& camera) {
  const double cosine = std::cos(view.azimuth_rad);
  const double sine = std::sin(view.azimuth_rad);
  const Eigen::Matrix3d R = view.T_camera_face.linear();
  Eigen::Matrix3d H;
  H << R * Eigen::Vector3d(-sine, cosine, 0.0), R * Eigen::Vector3d(cosine, sine, 0.0), view.T_camera_face.translation();
  Eigen::Matrix3d K;
  K << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  return K * H;
}

/// What the grid shows in the picture, with a margin; empty if that is not before the camera.
cv::Rect boundsOf(const Eigen::Matrix3d& H_image_grid, const cv::Size& grid, const cv::Size& image) {
  constexpr int kMargin = 4;
  Eigen::AlignedBox2d box;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector3d p = H_image_grid * Eigen::Vector3d(corner % 2 * (grid.width - 1), corner / 2 * (grid.height - 1), 1.0);
    box.extend(p.hnormalized());
  }
  const Eigen::Array2d limit(image.width + 1e4, image.height + 1e4);
  const Eigen::Array2d low = box.min().array().max(-1e4).min(limit);
  const Eigen::Array2d high = box.max().array().max(-1e4).min(limit);
  const cv::Rect wanted(cv::Point(static_cast<int>(low.x()) - kMargin, static_cast<int>(low.y()) - kMargin),
                        cv::Point(static_cast<int>(high.x()) + kMargin + 2, static_cast<int>(high.y()) + kMargin + 2));
  return wanted & cv::Rect(cv::Point(), image);
}

}  // namespace

FaceView viewFace(const Eigen::Isometry3d& T_camera_face, const camera::PinholeCamera& camera) {
  FaceView view;
  view.T_camera_face = T_camera_face;
  const Eigen::Vector3d eye_face = T_camera_face.inverse().translation();
  view.tilt_rad = std::atan2(eye_face.head<2>().norm(), eye_face.z());
  view.azimuth_rad = std::atan2(eye_face.y(), eye_face.x());
  const double depth_m = T_camera_face.translation().z();
  view.px_per_m = depth_m > 0.0 ? camera.fx / depth_m : 0.0;
  return view;
}

Eigen::Vector2d projectPatch(const FaceView& view, const camera::PinholeCamera& camera, const Eigen::Vector2d& point_patch) {
  return (homographyOf(view, camera) * point_patch.homogeneous()).hnormalized();
}

cv::Mat samplePatch(const cv::Mat& image, const camera::PinholeCamera& camera, const FaceView& view, const PatchGrid& grid) {
  Eigen::Matrix3d M_patch_grid;
  M_patch_grid << 1.0 / grid.px_per_m, 0.0, grid.centre_patch.x() - grid.origin_px.x() / grid.px_per_m, 0.0, 1.0 / grid.px_per_m,
      grid.centre_patch.y() - grid.origin_px.y() / grid.px_per_m, 0.0, 0.0, 1.0;
  Eigen::Matrix3d H_image_grid = homographyOf(view, camera) * M_patch_grid;
  const cv::Rect bounds = boundsOf(H_image_grid, grid.size, image.size());
  if (bounds.empty()) {
    return cv::Mat::zeros(grid.size, CV_MAKETYPE(CV_32F, image.channels()));
  }
  cv::Mat source = image(bounds);
  // Along the tilt the picture has fewer pixels than across it: its smoothing is between the two.
  const double coarseness = view.px_per_m / grid.px_per_m * (0.5 + 0.5 * std::cos(view.tilt_rad));
  if (coarseness > 1.2) {
    cv::Mat smooth;
    cv::GaussianBlur(source, smooth, cv::Size(0, 0), 0.45 * std::sqrt(coarseness * coarseness - 1.0), 0.0, cv::BORDER_REPLICATE);
    source = smooth;
  }
  Eigen::Matrix3d T = Eigen::Matrix3d::Identity();
  T(0, 2) = -bounds.x;
  T(1, 2) = -bounds.y;
  H_image_grid = T * H_image_grid;
  cv::Matx33d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix(row, column) = H_image_grid(row, column);
    }
  }
  cv::Mat patch;
  cv::warpPerspective(source, patch, matrix, grid.size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  patch.convertTo(patch, CV_32F, image.depth() == CV_8U ? 1.0 / 255.0 : 1.0);
  return patch;
}

}  // namespace oikos::recognition
