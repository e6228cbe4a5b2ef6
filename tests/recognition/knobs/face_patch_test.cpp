// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/face_patch.h"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>

namespace oikos::recognition {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const camera::PinholeCamera kCamera = {640, 480, 525.0, 525.0, 319.5, 239.5};

/// A camera 0.6 m away in a direction from the face, looking at it.
Eigen::Isometry3d cameraAt(double tilt_deg, double azimuth_deg) {
  const Eigen::Vector3d away = Eigen::AngleAxisd(azimuth_deg * kDegree, Eigen::Vector3d::UnitZ()) *
                               Eigen::Vector3d(std::sin(tilt_deg * kDegree), 0.0, std::cos(tilt_deg * kDegree));
  Eigen::Isometry3d T_face_camera = Eigen::Isometry3d::Identity();
  T_face_camera.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -away).toRotationMatrix();
  T_face_camera.translation() = 0.6 * away;
  return T_face_camera.inverse();
}

TEST(FacePatch, TiltAzimuthAndScaleAreThoseOfTheCamera) {
  const FaceView view = viewFace(cameraAt(35.0, -110.0), kCamera);
  EXPECT_NEAR(view.tilt_rad, 35.0 * kDegree, 1e-9);
  EXPECT_NEAR(view.azimuth_rad, -110.0 * kDegree, 1e-9);
  EXPECT_NEAR(view.px_per_m, 525.0 / 0.6, 1e-6);
}

TEST(FacePatch, BehindTheCameraHasNoScale) {
  EXPECT_EQ(viewFace(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.5)), kCamera).px_per_m, 0.0);
}

TEST(FacePatch, TheCameraStandsOnTheSideOfY) {
  const Eigen::Isometry3d T_camera_face = cameraAt(40.0, 70.0);
  const FaceView view = viewFace(T_camera_face, kCamera);
  const Eigen::Vector3d y_face(std::cos(70.0 * kDegree), std::sin(70.0 * kDegree), 0.0);
  for (const double y_m : {-0.02, 0.0, 0.03}) {
    const Eigen::Vector2d expected = kCamera.project(T_camera_face * (y_m * y_face));
    EXPECT_LT((projectPatch(view, kCamera, {0.0, y_m}) - expected).norm(), 1e-6);
  }
  EXPECT_LT((T_camera_face * (0.03 * y_face)).norm(), (T_camera_face * (-0.03 * y_face)).norm());
}

TEST(FacePatch, ShowsWhatThePictureShowsAtEachPoint) {
  cv::Mat picture(kCamera.height, kCamera.width, CV_32FC1);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      picture.at<float>(v, u) = static_cast<float>(0.001 * u + 0.0005 * v);  // which any resampling keeps
    }
  }
  const FaceView view = viewFace(cameraAt(45.0, 20.0), kCamera);
  for (const double px_per_m : {2000.0, 300.0}) {  // finer than the picture, and coarser
    PatchGrid grid;
    grid.size = {31, 21};
    grid.origin_px = {15.0, 10.0};
    grid.px_per_m = px_per_m;
    grid.centre_patch = {0.004, -0.003};
    const cv::Mat patch = samplePatch(picture, kCamera, view, grid);
    ASSERT_EQ(patch.size(), grid.size);
    for (const cv::Point& at : {cv::Point(15, 10), cv::Point(3, 4), cv::Point(27, 18)}) {
      const Eigen::Vector2d point = grid.centre_patch + (Eigen::Vector2d(at.x, at.y) - grid.origin_px) / px_per_m;
      const Eigen::Vector2d pixel = projectPatch(view, kCamera, point);
      EXPECT_NEAR(patch.at<float>(at), 0.001 * pixel.x() + 0.0005 * pixel.y(), 2e-4);
    }
  }
}

TEST(FacePatch, FarOutsideThePictureIsEmpty) {
  PatchGrid grid;
  grid.size = {8, 8};
  grid.px_per_m = 1000.0;
  grid.centre_patch = {5.0, 5.0};
  const cv::Mat picture(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar::all(200));
  const cv::Mat patch = samplePatch(picture, kCamera, viewFace(cameraAt(0.0, 0.0), kCamera), grid);
  EXPECT_EQ(patch.type(), CV_32FC3);
  EXPECT_EQ(cv::norm(patch), 0.0);
}

}  // namespace
}  // namespace oikos::recognition
