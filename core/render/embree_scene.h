// SPDX-License-Identifier: Apache-2.0
// Embree behind plain values. Included by this folder's sources only.
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "core/model/triangle_mesh.h"

namespace oikos::render {

constexpr int kPacketSize = 8;

/// Eight rays. A direction has its z of the camera frame 1 m, so a distance is a depth.
struct RayPacket {
  std::array<Eigen::Vector3f, kPacketSize> origin_map;
  std::array<Eigen::Vector3f, kPacketSize> direction_map;
  std::array<float, kPacketSize> near;
  std::array<float, kPacketSize> far;
  std::array<bool, kPacketSize> valid{};
};

struct RayHit {
  std::int32_t part = -1;  ///< -1: nothing
  std::uint32_t triangle = 0;
  float distance = 0.0F;  ///< in lengths of the ray's direction
  float u = 0.0F;         ///< barycentric, of the triangle's second corner
  float v = 0.0F;         ///< of its third
};

using HitPacket = std::array<RayHit, kPacketSize>;

/// Parts as instances of their meshes: one search tree a mesh, one over the instances.
class EmbreeScene {
 public:
  EmbreeScene();
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Parts are numbered in the order of these calls. The mesh is not read after the call; the same address means the same mesh.
  void addPart(const model::TriangleMesh& mesh_part);
  void movePart(int part, const Eigen::Isometry3d& T_map_part);
  void showPart(int part, bool is_shown);
  void commit();

  /// The nearest hit of each valid ray. Thread-safe between commits.
  void intersect(const RayPacket& rays, HitPacket& hits) const;
  /// Whether something lies between `near` and `far` of each valid ray; false for the others. Thread-safe between commits.
  [[nodiscard]] std::array<bool, kPacketSize> occluded(const RayPacket& rays) const;

 private:
  RTCScene treeOf(const model::TriangleMesh& mesh_part);
  void check() const;

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::map<const model::TriangleMesh*, RTCScene> trees_;
  std::vector<RTCGeometry> instances_;
};

}  // namespace oikos::render
