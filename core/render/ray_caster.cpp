// SPDX-License-Identifier: Apache-2.0
#include "core/render/ray_caster.h"

#include <cmath>

#include "core/render/surface_table.h"

namespace oikos::render {

namespace {

Eigen::Vector3d blendNormals(const model::TriangleMesh& mesh, std::uint32_t triangle, float u, float v) {
  const model::TriangleMesh::Triangle& corners = mesh.triangles[triangle];
  return ((1.0F - u - v) * mesh.normals[corners[0]] + u * mesh.normals[corners[1]] + v * mesh.normals[corners[2]]).cast<double>();
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
  Rays rays;
  RayPacket packet;
  aim(pixels, rays, packet);
  embree_.intersect(packet, surfaces.hit);
  Planes planes;
  findPlanes(rays, surfaces, planes);
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const double from_plane_m = planes.offset_m[i] - planes.normal_x[i] * rays.origin_x[i] - planes.normal_y[i] * rays.origin_y[i] -
                                planes.normal_z[i] * rays.origin_z[i];
    const double slope =
        planes.normal_x[i] * rays.direction_x[i] + planes.normal_y[i] * rays.direction_y[i] + planes.normal_z[i] * rays.direction_z[i];
    // The ray tracer's float distance says which surface; the plane says exactly where, unless it is seen edge-on.
    const double traced_m = surfaces.hit.distance[i];
    const double planar_m = from_plane_m / slope;
    const double depth_m = std::abs(planar_m - traced_m) < 1e-3 * traced_m ? planar_m : traced_m;
    surfaces.depth_m[i] = static_cast<float>(depth_m);
    surfaces.x[i] = static_cast<float>(rays.origin_x[i] + depth_m * rays.direction_x[i]);
    surfaces.y[i] = static_cast<float>(rays.origin_y[i] + depth_m * rays.direction_y[i]);
    surfaces.z[i] = static_cast<float>(rays.origin_z[i] + depth_m * rays.direction_z[i]);
  }
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const float x = packet.direction_x[i];
    const float y = packet.direction_y[i];
    const float z = packet.direction_z[i];
    const float per_length = -1.0F / std::sqrt(x * x + y * y + z * z);
    surfaces.to_camera_x[i] = x * per_length;
    surfaces.to_camera_y[i] = y * per_length;
    surfaces.to_camera_z[i] = z * per_length;
  }
}

void RayCaster::aim(const PixelPacket& pixels, Rays& rays, RayPacket& packet) const {
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const PixelRay& pixel = pixels[i];
    const bool is_ray = pixel.u_px >= 0;
    const Eigen::Isometry3d& T = T_map_camera(is_ray ? pixel.v_px : 0);
    const Eigen::Vector2d ray = is_ray ? rays_.at(pixel.u_px, pixel.v_px, pixel.offset_px) : Eigen::Vector2d::Zero();
    const Eigen::Vector3d direction = T.linear().col(0) * ray.x() + T.linear().col(1) * ray.y() + T.linear().col(2);
    rays.direction_x[i] = direction.x();
    rays.direction_y[i] = direction.y();
    rays.direction_z[i] = direction.z();
    rays.origin_x[i] = T.translation().x();
    rays.origin_y[i] = T.translation().y();
    rays.origin_z[i] = T.translation().z();
    packet.valid[i] = is_ray ? -1 : 0;
  }
  const auto round = [](const Lanes<double>& from, Lanes<float>& to) {
    for (std::size_t i = 0; i < kPacketSize; ++i) {
      to[i] = static_cast<float>(from[i]);
    }
  };
  round(rays.direction_x, packet.direction_x);
  round(rays.direction_y, packet.direction_y);
  round(rays.direction_z, packet.direction_z);
  round(rays.origin_x, packet.origin_x);
  round(rays.origin_y, packet.origin_y);
  round(rays.origin_z, packet.origin_z);
  packet.near.fill(near_m_);
  packet.far.fill(far_m_);
}

void RayCaster::findPlanes(const Rays& rays, SurfacePacket& surfaces, Planes& planes) const {
  const HitPacket& hit = surfaces.hit;
  const ScenePart* part = nullptr;
  Eigen::Vector3d normal_map = Eigen::Vector3d::Zero();
  double offset_m = 0.0;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const bool is_same = i > 0 && hit.part[i] == hit.part[i - 1] && hit.triangle[i] == hit.triangle[i - 1];
    if (!is_same) {
      part = hit.part[i] < 0 ? nullptr : &parts_[static_cast<std::size_t>(hit.part[i])];
      const SurfaceTriangle surface = part == nullptr ? SurfaceTriangle{} : (*part->surfaces)[hit.triangle[i]];
      normal_map = part == nullptr ? surface.normal_part : Eigen::Vector3d(part->T_map_part.linear() * surface.normal_part);
      offset_m = part == nullptr ? 0.0 : surface.offset_m + normal_map.dot(part->T_map_part.translation());
    }
    planes.normal_x[i] = normal_map.x();
    planes.normal_y[i] = normal_map.y();
    planes.normal_z[i] = normal_map.z();
    planes.offset_m[i] = offset_m;
    Eigen::Vector3d look_map = normal_map;
    if (part != nullptr && !part->mesh_part->normals.empty()) {
      look_map = (part->T_map_part.linear() * blendNormals(*part->mesh_part, hit.triangle[i], hit.u[i], hit.v[i])).normalized();
    }
    const double slope = normal_map.x() * rays.direction_x[i] + normal_map.y() * rays.direction_y[i] + normal_map.z() * rays.direction_z[i];
    const double side = slope > 0.0 ? -1.0 : 1.0;  // seen from behind
    surfaces.normal_x[i] = static_cast<float>(side * look_map.x());
    surfaces.normal_y[i] = static_cast<float>(side * look_map.y());
    surfaces.normal_z[i] = static_cast<float>(side * look_map.z());
  }
}

}  // namespace oikos::render
