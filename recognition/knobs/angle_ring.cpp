// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/angle_ring.h"

#include <Eigen/Eigenvalues>
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
constexpr double kWeakest = 2e-3;  // of a basis's strongest direction, in energy: what is weaker is noise

constexpr int kShades = 4;  // constant, and the normal's x, y, z

using Images = std::vector<cv::Mat>;  // CV_32FC1 of the window's size

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

/// Where the window is looked at from. Frame `patch`: as FaceView's, for a camera at azimuth 0 of the ring.
struct Window {
  int columns;
  int rows;
  int origin_column;
  int origin_row;
  double px_per_m;
  double tilt_rad;
};

/// A camera so far away that its picture, stretched along the tilt, is the window as samplePatch would cut it.
camera::PinholeCamera windowCamera(const Window& window, double distance_m) {
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
Images basisImages(const render::View& view, int materials, const Window& window) {
  Images images(static_cast<std::size_t>(materials * kShades + 1));
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

/// How much the pixels of the support count: what is printed on the carrier is not known.
Eigen::VectorXf weigh(const cv::Mat& carrier, const std::vector<int>& support, float carrier_weight) {
  Eigen::VectorXf weights(static_cast<Eigen::Index>(support.size()));
  for (std::size_t k = 0; k < support.size(); ++k) {
    const float share = carrier.ptr<float>()[support[k]];
    weights[static_cast<Eigen::Index>(k)] = 1.0F - share + carrier_weight * share;
  }
  return weights / std::exp(weights.array().log().mean());
}

/// An orthonormal basis of what the images span on the support, weighted; a row a vector, times the weights' roots.
Eigen::MatrixXf orthonormal(const Images& images, const std::vector<int>& support, const Eigen::VectorXf& weights) {
  const Eigen::VectorXf roots = weights.cwiseSqrt();
  const Eigen::VectorXf constant = roots.normalized();
  Eigen::MatrixXf columns(static_cast<Eigen::Index>(support.size()), static_cast<Eigen::Index>(images.size()));
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t k = 0; k < support.size(); ++k) {
      columns(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = images[i].ptr<float>()[support[k]];
    }
  }
  columns = roots.asDiagonal() * columns;
  columns -= constant * (constant.transpose() * columns).eval();
  const Eigen::MatrixXd gram = (columns.transpose() * columns).cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  const Eigen::VectorXd& energies = solver.eigenvalues();
  const double least = kWeakest * energies.maxCoeff();
  const auto kept = std::max<Eigen::Index>(1, (energies.array() > least).count());
  const Eigen::VectorXf scale = energies.tail(kept).cwiseMax(1e-12).cwiseSqrt().cwiseInverse().cast<float>();
  Eigen::MatrixXf basis(kept + 1, columns.rows());
  basis.row(0) = constant.transpose();
  basis.bottomRows(kept) = scale.asDiagonal() * (columns * solver.eigenvectors().rightCols(kept).cast<float>()).transpose();
  return basis * roots.asDiagonal();
}

}  // namespace

AngleRing::AngleRing(const KnobDescription& knob, const KnobFace& face, double tilt_rad, const RingShape& shape) : shape_(shape) {
  const double px_per_m = shape.radius_px / face.radius_m;
  const int rim = std::max(2, shape.radius_px / 7);
  const int below = static_cast<int>(std::ceil(face.height_m * px_per_m * std::tan(tilt_rad)));
  origin_column_ = shape.radius_px + rim;
  origin_row_ = shape.radius_px + rim;
  columns_ = 2 * origin_column_ + 1;
  rows_ = 2 * origin_row_ + 1 + below;
  const Window window{columns_, rows_, origin_column_, origin_row_, px_per_m, tilt_rad};
  const double distance_m = kFarAway * face.radius_m;
  const render::CameraRays rays(windowCamera(window, distance_m));

  render::Scene scene;
  const auto meshes = splitByMaterial(*knob.mesh_knob);
  for (const auto& mesh : meshes) {
    scene.add(mesh, face.T_knob_face.inverse());
  }
  scene.commit();
  const auto materials = static_cast<int>(meshes.size());
  render::ViewConfig config;
  config.with_parts = true;
  config.with_normals = true;
  config.far_m = 2.0 * distance_m;

  std::vector<Images> all;
  cv::Mat covered = cv::Mat::zeros(rows_, columns_, CV_32FC1);
  for (int i = 0; i < shape.angles; ++i) {
    const double azimuth_rad = 2.0 * std::numbers::pi * i / shape.angles;
    Eigen::Isometry3d T_face_camera = Eigen::Isometry3d::Identity();
    T_face_camera.linear() = cameraAxes(tilt_rad, azimuth_rad);
    T_face_camera.translation() = -distance_m * T_face_camera.linear().col(2);
    all.push_back(basisImages(render::renderView(scene, rays, {T_face_camera, {}}, config), materials, window));
    covered = cv::max(covered, 1.0 - all.back().back());
    for (cv::Mat& image : all.back()) {
      cv::GaussianBlur(image, image, cv::Size(5, 5), kTemplateBlur_px, 0.0, cv::BORDER_REPLICATE);
    }
  }
  cv::Mat wide;
  cv::dilate(covered, wide, cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(3, 3)));
  for (int i = 0; i < rows_ * columns_; ++i) {
    if (wide.ptr<float>()[i] > 0.5F) {
      support_.push_back(i);
    }
  }
  std::vector<Eigen::MatrixXf> bases;
  first_row_.push_back(0);
  weights_.resize(shape.angles, static_cast<Eigen::Index>(support_.size()));
  for (const Images& images : all) {
    const Eigen::VectorXf weights = weigh(images.back(), support_, shape.carrier_weight);
    weights_.row(static_cast<Eigen::Index>(bases.size())) = weights.transpose();
    bases.push_back(orthonormal(images, support_, weights));
    first_row_.push_back(first_row_.back() + static_cast<int>(bases.back().rows()));
  }
  bases_.resize(first_row_.back(), static_cast<Eigen::Index>(support_.size()));
  for (std::size_t i = 0; i < bases.size(); ++i) {
    bases_.middleRows(first_row_[i], bases[i].rows()) = bases[i];
  }
}

}  // namespace oikos::recognition
