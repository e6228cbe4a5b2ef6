// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "core/camera/pinhole_camera.h"
#include "core/camera/sensor/ideal_view.h"

namespace oikos::test {

/// Matt surfaces with exact depth: a wall, and boards at right angles to the optical axis before it.
class FlatScene {
 public:
  explicit FlatScene(const camera::PinholeCamera& camera) : camera_(camera) {
    const cv::Size size(camera.width, camera.height);
    view_.depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
    view_.normal_camera = cv::Mat(size, CV_32FC3, cv::Scalar(0.0, 0.0, 0.0));
    view_.reflectivity = cv::Mat(size, CV_32FC1, cv::Scalar(0.0));
    view_.gloss = cv::Mat(size, CV_32FC1, cv::Scalar(0.0));
  }

  /// A plane that cuts the optical axis at z_m, turned by theta about the image's y axis: nearer on the right.
  FlatScene& addPlane(double z_m, double theta_rad, double reflectivity = 0.8) {
    const Eigen::Vector3d normal(-std::sin(theta_rad), 0.0, -std::cos(theta_rad));
    const double distance_m = normal.z() * z_m;
    for (int v = 0; v < camera_.height; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        const double along = normal.dot(camera_.ray(u, v));
        if (along < -1e-6) {
          set({u, v}, distance_m / along, normal, reflectivity);
        }
      }
    }
    return *this;
  }

  /// A board over a rectangle of pixels.
  FlatScene& addBoard(const cv::Rect& pixels, double z_m, double reflectivity = 0.8) {
    for (int v = pixels.y; v < pixels.y + pixels.height; ++v) {
      for (int u = pixels.x; u < pixels.x + pixels.width; ++u) {
        set({u, v}, z_m, -Eigen::Vector3d::UnitZ(), reflectivity);
      }
    }
    return *this;
  }

  FlatScene& setGloss(double gloss) {
    view_.gloss = cv::Scalar(gloss);
    return *this;
  }

  [[nodiscard]] const camera::IdealView& view() const { return view_; }
  [[nodiscard]] const camera::PinholeCamera& camera() const { return camera_; }

 private:
  void set(const cv::Point& pixel, double z_m, const Eigen::Vector3d& normal, double reflectivity) {
    view_.depth_m.at<float>(pixel) = static_cast<float>(z_m);
    const Eigen::Vector3f n = normal.cast<float>();
    view_.normal_camera.at<cv::Vec3f>(pixel) = cv::Vec3f(n.x(), n.y(), n.z());
    view_.reflectivity.at<float>(pixel) = static_cast<float>(reflectivity);
  }

  camera::PinholeCamera camera_;
  camera::IdealView view_;
};

}  // namespace oikos::test
