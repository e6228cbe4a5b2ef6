// SPDX-License-Identifier: Apache-2.0
// What a camera sees of a scene.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/render/camera_rays.h"
#include "core/render/lighting.h"
#include "core/render/scene.h"

namespace oikos::render {

struct Viewpoint {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  /// Where the camera is when its last row is read, if it moves meanwhile (rolling shutter); T_map_camera is then that of the first row.
  std::optional<Eigen::Isometry3d> T_map_camera_last_row;
};

struct ViewConfig {
  bool with_normals = false;
  bool with_parts = false;
  bool with_color = false;
  bool with_surface = false;
  double near_m = 0.02;  ///< along the optical axis
  double far_m = 50.0;
  Eigen::Vector3f background_rgb = Eigen::Vector3f::Zero();  ///< linear; where nothing is hit
  Lighting lighting;
  int threads = 1;
};

/// Images of the camera's size; those not asked for are empty.
struct View {
  cv::Mat depth_m;        ///< CV_32FC1, along the optical axis; NaN: nothing there
  cv::Mat normal_camera;  ///< CV_32FC3, length 1, on the side that is seen; 0 where nothing is
  cv::Mat part;           ///< CV_32SC1, index into Scene::parts(); -1: none
  cv::Mat color;          ///< CV_8UC3, BGR, sRGB; pixels on edges are the mean of four rays
  cv::Mat albedo;         ///< CV_32FC1, 0 to 1: how much light the surface throws back, whatever falls on it; 0 where nothing is
  cv::Mat gloss;          ///< CV_32FC1, 0 to 1, as Material::gloss
};

/// Casts one ray a pixel; depths and normals come from the hit triangle's plane in double precision. The same bytes for any number of
/// threads. Thread-safe while the scene is not changed.
[[nodiscard]] View renderView(const Scene& scene, const CameraRays& rays, const Viewpoint& viewpoint, const ViewConfig& config);

}  // namespace oikos::render
