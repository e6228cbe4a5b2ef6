// SPDX-License-Identifier: Apache-2.0
#include "core/render/ray_caster.h"

#include <cmath>

namespace oikos::render {

namespace {

/// Of the first corner and along two sides, in the part's frame.
struct Plane {
  Eigen::Vector3d corner;
  Eigen::Vector3d normal;  ///< not normalised
};

Plane planeOf(const model::TriangleMesh& mesh, std::uint32_t triangle) {
  const model::TriangleMesh::Triangle& corners = mesh.triangles[triangle];
  const Eigen::Vector3d first = mesh.vertices[corners[0]].cast<double>();
  const Eigen::Vector3d second = mesh.vertices[corners[1]].cast<double>();
  const Eigen::Vector3d third = mesh.vertices[corners[2]].cast<double>();
  return {first, (second - first).cross(third - first)};
}

Eigen::Vector3d shadingNormal(const model::TriangleMesh& mesh, const RayHit& hit, const Eigen::Vector3d& plane_normal) {
  if (mesh.normals.empty()) {
    return plane_normal;
  }
  const model::TriangleMesh::Triangle& corners = mesh.triangles[hit.triangle];
  const Eigen::Vector3f blended =
      (1.0F - hit.u - hit.v) * mesh.normals[corners[0]] + hit.u * mesh.normals[corners[1]] + hit.v * mesh.normals[corners[2]];
  return blended.cast<double>();
}

std::vector<Eigen::Isometry3d> poseOfRows(const Viewpoint& viewpoint, int rows) {
  if (!viewpoint.T_map_camera_last_row) {
    return {viewpoint.T_map_camera};
  }
  const Eigen::Quaterniond first(viewpoint.T_map_camera.linear());
  const Eigen::Quaterniond last(viewpoint.T_map_camera_last_row->linear());
  std::vector<Eigen::Isometry3d> T_map_camera;
  for (int v = 0; v < rows; ++v) {
    const double share = rows > 1 ? static_cast<double>(v) / (rows - 1) : 0.0;
    Eigen::Isometry3d T(first.slerp(share, last));
    T.translation() = (1.0 - share) * viewpoint.T_map_camera.translation() + share * viewpoint.T_map_camera_last_row->translation();
    T_map_camera.push_back(T);
  }
  return T_map_camera;
}

}  // namespace

RayCaster::RayCaster(const Scene& scene, const CameraRays& rays, const Viewpoint& viewpoint, const ViewConfig& config)
    : parts_(scene.parts()),
      embree_(scene.embree()),
      rays_(rays),
      near_m_(static_cast<float>(config.near_m)),
      far_m_(static_cast<float>(config.far_m)),
      T_map_camera_rows_(poseOfRows(viewpoint, rays.height())) {}

void RayCaster::cast(const PixelPacket& pixels, SurfacePacket& surfaces) const {
  RayPacket packet;
  std::array<Eigen::Vector3d, kPacketSize> direction_map;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const PixelRay& pixel = pixels[i];
    packet.valid[i] = pixel.u_px >= 0;
    const Eigen::Isometry3d& T = T_map_camera(packet.valid[i] ? pixel.v_px : 0);
    const Eigen::Vector2d ray = packet.valid[i] ? rays_.at(pixel.u_px, pixel.v_px, pixel.offset_px) : Eigen::Vector2d::Zero();
    direction_map[i] = T.linear() * ray.homogeneous();
    packet.direction_map[i] = direction_map[i].cast<float>();
    packet.origin_map[i] = T.translation().cast<float>();
    packet.near[i] = near_m_;
    packet.far[i] = far_m_;
  }
  HitPacket hits;
  embree_.intersect(packet, hits);
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    surfaces[i] = hits[i].part < 0 ? SurfacePoint{} : surfaceAt(hits[i], T_map_camera(pixels[i].v_px).translation(), direction_map[i]);
  }
}

SurfacePoint RayCaster::surfaceAt(const RayHit& hit, const Eigen::Vector3d& origin_map, const Eigen::Vector3d& direction_map) const {
  const ScenePart& part = parts_[static_cast<std::size_t>(hit.part)];
  const Eigen::Matrix3d R_map_part = part.T_map_part.linear();
  const Eigen::Vector3d origin_part = R_map_part.transpose() * (origin_map - part.T_map_part.translation());
  const Eigen::Vector3d direction_part = R_map_part.transpose() * direction_map;
  const Plane plane = planeOf(*part.mesh_part, hit.triangle);
  // The ray tracer's float distance says which surface; the plane says exactly where, unless it is seen edge-on.
  double depth_m = plane.normal.dot(plane.corner - origin_part) / plane.normal.dot(direction_part);
  const double traced_m = hit.distance;
  depth_m = std::abs(depth_m - traced_m) < 1e-3 * traced_m ? depth_m : traced_m;
  Eigen::Vector3d normal_part = shadingNormal(*part.mesh_part, hit, plane.normal).normalized();
  if (plane.normal.dot(direction_part) > 0.0) {
    normal_part = -normal_part;  // seen from behind
  }
  SurfacePoint surface;
  surface.hit = hit;
  surface.depth_m = static_cast<float>(depth_m);
  surface.point_map = (origin_map + depth_m * direction_map).cast<float>();
  surface.normal_map = (R_map_part * normal_part).cast<float>();
  surface.to_camera_map = -direction_map.normalized().cast<float>();
  return surface;
}

}  // namespace oikos::render
