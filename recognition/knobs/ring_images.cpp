// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/ring_images.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/render/view.h"

namespace oikos::recognition {

namespace {

constexpr int kSuperSampling = 2;
constexpr double kFarAway = 200.0;  // in radii: nearly parallel rays
constexpr double kTemplateBlur_px = 0.7;

constexpr int kShades = 4;  // constant, and the normal's x, y, z

/// The mesh once a material, so that a render tells them apart.
std::vector<std::shared_ptr<const model::TriangleMesh>> splitByMaterial(const model::TriangleMesh& mesh) {
  std::map<std::uint32_t, model::TriangleMesh> parts;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t material = mesh.triangle_materials.empty() ? 0 : mesh.triangle_materials[i];
    model::TriangleMesh& part = parts[material];
    if (part.vertices.empty()) {
      part.vertices = mesh.vertices;
      part.normals = mesh.normals;
    }
    part.triangles.push_back(mesh.triangles[i]);
  }
  std::vector<std::shared_ptr<const model::TriangleMesh>> meshes;
  for (auto& [material, part] : parts) {
    meshes.push_back(std::make_shared<const model::TriangleMesh>(std::move(part)));
  }
  return meshes;
}

/// A camera so far away that its picture, stretched along the tilt, is the window as samplePatch would cut it.
camera::PinholeCamera windowCamera(const RingWindow& window, double distance_m) {
  camera::PinholeCamera camera;
  camera.width = window.columns * kSuperSampling;
  camera.height = window.rows * kSuperSampling;
  camera.fx = window.px_per_m * kSuperSampling * distance_m;
  camera.fy = camera.fx / std::cos(window.tilt_rad);
  camera.cx = window.origin_column * kSuperSampling + (kSuperSampling - 1) / 2.0;
  camera.cy = window.origin_row * kSuperSampling + (kSuperSampling - 1) / 2.0;
  return camera;
}

Eigen::Matrix3d cameraAxes(double tilt_rad, double azimuth_rad) {
  const Eigen::Vector3d towards(std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R_face_camera;
  R_face_camera << up.cross(towards), std::cos(tilt_rad) * towards - std::sin(tilt_rad) * up,
      -std::sin(tilt_rad) * towards - std::cos(tilt_rad) * up;
  return R_face_camera;
}

/// Mask and shades of each material of the knob, then the mask of what it stands on.
std::vector<cv::Mat> basisImages(const render::View& view, int materials, const RingWindow& window) {
  std::vector<cv::Mat> images(static_cast<std::size_t>(materials * kShades + 1));
  for (cv::Mat& image : images) {
    image = cv::Mat::zeros(window.rows, window.columns, CV_32FC1);
  }
  constexpr float kShare = 1.0F / (kSuperSampling * kSuperSampling);
  for (int v = 0; v < view.part.rows; ++v) {
    for (int u = 0; u < view.part.cols; ++u) {
      const int part = view.part.at<std::int32_t>(v, u);
      const cv::Point at(u / kSuperSampling, v / kSuperSampling);
      if (part < 0 || part >= materials) {
        images.back().at<float>(at) += kShare;
        continue;
      }
      const auto& normal = view.normal_camera.at<cv::Vec3f>(v, u);
      const auto first = static_cast<std::size_t>(part * kShades);
      images[first].at<float>(at) += kShare;
      for (int i = 0; i + 1 < kShades; ++i) {
        images[first + 1 + static_cast<std::size_t>(i)].at<float>(at) += kShare * normal[i];
      }
    }
  }
  return images;
}

}  // namespace

void blurTemplate(cv::Mat& image) {
  cv::GaussianBlur(image, image, cv::Size(5, 5), kTemplateBlur_px, 0.0, cv::BORDER_REPLICATE);
}

RingWindow windowOf(const KnobFace& face, double tilt_rad, const RingShape& shape) {
  RingWindow window;
  window.px_per_m = shape.radius_px / face.radius_m;
  window.tilt_rad = tilt_rad;
  const int rim = std::max(2, shape.radius_px / 7);
  const int below = static_cast<int>(std::ceil(face.height_m * window.px_per_m * std::tan(tilt_rad)));
  window.origin_column = shape.radius_px + rim;
  window.origin_row = shape.radius_px + rim;
  window.columns = 2 * window.origin_column + 1;
  window.rows = 2 * window.origin_row + 1 + below;
  return window;
}

std::vector<TemplateImages> renderImages(const KnobDescription& knob, const KnobFace& face, const RingWindow& window, int angles) {
  const double distance_m = kFarAway * face.radius_m;
  const render::CameraRays rays(windowCamera(window, distance_m));
  render::Scene scene;
  const auto meshes = splitByMaterial(*knob.mesh_knob);
  for (const auto& mesh : meshes) {
    scene.add(mesh, face.T_knob_face.inverse());
  }
  scene.commit();
  render::ViewConfig config;
  config.with_parts = true;
  config.with_normals = true;
  config.far_m = 2.0 * distance_m;
  std::vector<TemplateImages> templates;
  for (int i = 0; i < angles; ++i) {
    Eigen::Isometry3d T_face_camera = Eigen::Isometry3d::Identity();
    T_face_camera.linear() = cameraAxes(window.tilt_rad, 2.0 * std::numbers::pi * i / angles);
    T_face_camera.translation() = -distance_m * T_face_camera.linear().col(2);
    const render::View view = render::renderView(scene, rays, {T_face_camera, {}}, config);
    TemplateImages images;
    images.images = basisImages(view, static_cast<int>(meshes.size()), window);
    images.covered = 1.0 - images.images.back();
    std::for_each(images.images.begin(), images.images.end(), blurTemplate);
    templates.push_back(std::move(images));
  }
  return templates;
}

}  // namespace oikos::recognition
