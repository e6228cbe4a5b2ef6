// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/front_face.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace oikos::registration {

namespace {

constexpr double kFacing = 0.98;  // cosine
constexpr double kSamePlane_m = 0.002;

/// By how many steps of kSamePlane_m behind the grip's middle: what lies there.
struct Layer {
  double area_sq_m = 0.0;
  double depth_area = 0.0;  ///< sum of depth * area
  Eigen::AlignedBox2d outline_handle;
};

std::map<int, Layer> layersBehind(const model::TriangleMesh& mesh_part, const Eigen::Isometry3d& T_part_handle, double max_reach_m) {
  const Eigen::Isometry3d T_handle_part = T_part_handle.inverse();
  std::map<int, Layer> layers;
  for (const auto& triangle : mesh_part.triangles) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) {
      corners.col(i) = T_handle_part * mesh_part.vertices[triangle[static_cast<std::size_t>(i)]].cast<double>();
    }
    const Eigen::Vector3d cross = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    const double depth_m = -corners.row(0).mean();
    if (cross.x() < kFacing * cross.norm() || depth_m < 0.0 || depth_m > max_reach_m) {
      continue;
    }
    Layer& layer = layers[static_cast<int>(std::lround(depth_m / kSamePlane_m))];
    layer.area_sq_m += 0.5 * cross.norm();
    layer.depth_area += 0.5 * cross.norm() * depth_m;
    for (int i = 0; i < 3; ++i) {
      layer.outline_handle.extend(Eigen::Vector2d(corners.col(i).tail<2>()));
    }
  }
  return layers;
}

std::optional<FrontFace> faceBehind(const model::ArticulatedModel& model, int handle, double max_reach_m) {
  const model::ModelHandle& of = model.handles[static_cast<std::size_t>(handle)];
  const auto& mesh = model.parts[static_cast<std::size_t>(of.part)].mesh_part;
  const std::map<int, Layer> layers = mesh ? layersBehind(*mesh, of.T_part_handle, max_reach_m) : std::map<int, Layer>();
  const auto widest =
      std::max_element(layers.begin(), layers.end(), [](const auto& a, const auto& b) { return a.second.area_sq_m < b.second.area_sq_m; });
  if (widest == layers.end()) {
    return std::nullopt;
  }
  FrontFace face;
  face.part = of.part;
  const double depth_m = widest->second.depth_area / widest->second.area_sq_m;
  face.T_part_front = of.T_part_handle * Eigen::Translation3d(-depth_m, 0.0, 0.0);
  face.outline_front = widest->second.outline_handle;
  return face;
}

bool isSameFace(const FrontFace& a, const FrontFace& b) {
  const Eigen::Isometry3d T_a_b = a.T_part_front.inverse() * b.T_part_front;
  return a.part == b.part && T_a_b.linear()(0, 0) > kFacing && std::abs(T_a_b.translation().x()) < kSamePlane_m;
}

}  // namespace

std::vector<FrontFace> frontFaces(const model::ArticulatedModel& model, double max_reach_m) {
  std::vector<FrontFace> faces;
  for (int handle = 0; handle < static_cast<int>(model.handles.size()); ++handle) {
    const std::optional<FrontFace> face = faceBehind(model, handle, max_reach_m);
    if (!face) {
      continue;
    }
    auto same = std::find_if(faces.begin(), faces.end(), [&](const FrontFace& known) { return isSameFace(known, *face); });
    if (same == faces.end()) {
      same = faces.insert(faces.end(), *face);
    }
    const Eigen::Isometry3d& T_part_handle = model.handles[static_cast<std::size_t>(handle)].T_part_handle;
    same->handles.push_back({handle, same->T_part_front.inverse() * T_part_handle});
  }
  return faces;
}

}  // namespace oikos::registration
